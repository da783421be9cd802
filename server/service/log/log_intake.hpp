#pragma once

#include "db/store/keys_store.hpp"
#include "proof/note.hpp"
#include "record/measurement.hpp"
#include "record/origins.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// Rows of a station's log on their way to the centre, with the signed head that they lead to.
/// Texts are views of memory that outlives the batch.
struct ForwardedBatch {
  struct Row {
    /// Measurement as its station stored it. The corrected measurement is in `correction_of` and
    /// the digits of `corrected_elsewhere`.
    Measurement measurement;
    std::string_view record;  ///< its text, which is the leaf
  };
  std::string origin;  ///< 16 hexadecimal digits
  /// The log that the branch continues, and the number of its rows; no digits: no branch.
  struct Base {
    std::string origin{};
    std::int64_t size = 0;
  };
  Base base{};
  std::int64_t from = 1;  ///< the place of the first row in its log
  std::string key;        ///< the vkey of the station
  std::string checkpoint;
  std::vector<std::string> hand_overs;  ///< checkpoints that hand over from a key to the next
  std::vector<Row> rows;
  /// Stored for idempotency keys with the rows.
  std::vector<store::IdempotencyStore::Forwarded> answers;
  std::vector<Note> notes;  ///< with the ids that they got there, in their order
  std::string notes_after;  ///< the id of the note before the first; empty: there is none
};

/// Stores batches of stations: each batch must continue exactly at the end of its log here, and is
/// stored whole or not at all. Thread-safe.
class LogIntake {
 public:
  /// Most rows of a batch.
  static constexpr std::size_t kMostRows = 10'000;

  /// The event's name and a sentence, for the log of the service.
  using Tell = std::function<void(std::string_view event, const std::string& detail)>;

  LogIntake(Database& database, TableCatalog& tables, Origins& origins, const Clock& clock,
            Tell tell)
      : database_(database),
        tables_(tables),
        origins_(origins),
        clock_(clock),
        tell_(std::move(tell)) {}

  /// The part of a log that the centre has.
  struct Head {
    std::uint64_t size = 0;
    tlog::Hash root{};
  };
  enum class Outcome { Taken, Elsewhere, Forked };
  struct Answer {
    /// Elsewhere: the batch does not begin at the end of the log here, and nothing was stored.
    /// Forked: its checkpoint contradicts the log here; it is stored and reported from then on.
    Outcome outcome = Outcome::Taken;
    Head head;
  };

  /// Blocks.
  /// @errors LogKeyUnknown, NoteMalformed, NoteUnverified, KeyMalformed, LogRootMismatch,
  ///   LogRecordInvalid, RequestInvalid; those of storage.
  Result<Answer> take(const ForwardedBatch& batch);

 private:
  struct Known;
  struct Judged;

  Result<Known> read(const ForwardedBatch& batch) const;
  Result<void> read_base(const Stores& stores, const ForwardedBatch& batch, Known& known) const;
  Result<void> trust(const ForwardedBatch& batch, Known& known) const;
  Result<void> check_rows(const ForwardedBatch& batch) const;
  Result<Judged> judge_tree(const ForwardedBatch& batch, const Known& known) const;
  Result<void> prepare(const ForwardedBatch& batch, Known& known);
  void tell_branch(const ForwardedBatch& batch, const Known& known) const;
  Result<bool> store_rows(Stores& stores, const ForwardedBatch& batch, const Known& known,
                          const Judged& judged) const;
  Result<void> store_notes(Stores& stores, const ForwardedBatch& batch, std::int64_t station) const;
  void fork(const ForwardedBatch& batch, const Known& known);

  Database& database_;
  TableCatalog& tables_;
  Origins& origins_;
  const Clock& clock_;
  const Tell tell_;
};

}  // namespace fitgauge::app

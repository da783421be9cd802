#pragma once

#include "db/store/documents_store.hpp"
#include "db/store/keys_store.hpp"
#include "proof/note.hpp"
#include "record/measurement.hpp"
#include "service/log/log_service.hpp"
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
class LogIntake : Records {
 public:
  /// Most rows of a batch.
  static constexpr std::size_t kMostRows = 10'000;

  LogIntake(const Records& records, Tell tell) : Records(records), tell_(std::move(tell)) {}

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

  const Tell tell_;
};

/// The part of this folder's log that a centre does not have yet. The log itself is the outbox;
/// only the confirmed position is stored with it. Functions block. Thread-safe.
class LogOutbox {
 public:
  static constexpr std::int64_t kMostRows = 10'000;
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20;

  LogOutbox(Database& database, const TableCatalog& tables, LogService& log)
      : database_(database), tables_(tables), log_(log) {}

  struct Batch {
    std::string_view origin{};  ///< the digits of the history that its records are of
    /// The earlier history that it continues, and the number of its rows; no digits: none.
    std::string_view base{};
    std::int64_t base_size = 0;
    /// Set if the key of the history was lost: nothing is signed, the history ends here, and the
    /// batch is empty.
    std::optional<std::int64_t> unsigned_to{};
    std::int64_t from = 1;  ///< the place of its first record
    std::string checkpoint{};
    std::string key{};  ///< the vkey
    std::vector<std::string> hand_overs{};
    std::vector<std::string> records{};
    std::vector<store::IdempotencyStore::Forwarded> answers{};
    std::vector<std::string> notes{};  ///< as JSON
    std::string notes_after{};   ///< the id of the note before the first; empty: there is none
    std::int64_t last_note = 0;  ///< the number in the id of the last of them
  };
  /// Returns at most `most` records of one history, after its first `after` records.
  /// @param noted adds the notes after this number, if the centre then has their measurements;
  ///   none: the centre accepts no notes.
  /// @errors those of storage.
  Result<Batch> next(std::int64_t after, std::int64_t most,
                     std::optional<std::int64_t> noted) const;

  /// Compares the root of the first `size` records here; none if there are fewer records.
  Result<std::optional<bool>> begins_with(std::int64_t size, const tlog::Hash& root) const;

  /// Number of records that this centre has confirmed. @errors those of storage.
  Result<std::int64_t> confirmed(std::string_view centre) const;
  Result<void> confirm(std::string_view centre, std::int64_t size) const;

  /// The history of a place in the log.
  const LogService::History& history_of(std::int64_t place) const { return log_.history_of(place); }
  /// The newest history that has records.
  std::string_view newest_history() const;
  /// Whether the note with this number is of that history.
  bool is_note_of(std::string_view history, std::int64_t number) const;
  /// Keeps the digits of the centre's history. A failure of storage is left to the next call.
  void meet(std::string_view centre) const;
  /// Sets the fork; see LogService.
  void set_forked(const std::optional<std::string>& why) const;

  struct Waiting {
    std::int64_t rows = 0;
    std::optional<Timestamp> oldest{};  ///< when the first of them was received
  };
  Result<Waiting> waiting(std::int64_t confirmed) const;

  /// Returns the number of records after the last commit; 0 before the first one since the start.
  /// Does not block.
  std::int64_t committed() const;

 private:
  const LogService::History* empty_history(std::int64_t note) const;
  void add_notes(const Stores& stores, std::int64_t place, std::int64_t behind,
                 std::vector<store::Note> notes, Batch& batch) const;

  Database& database_;
  const TableCatalog& tables_;
  LogService& log_;
};

}  // namespace fitgauge::app

#pragma once

#include "db/store/keys_store.hpp"
#include "db/store/measurement_index.hpp"
#include "record/measurement.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// A move of the value that was read as number `from`: to the place before the value that was read
/// as number `to`. Both count from 0, and `to` is at most `from`.
struct MovedValue {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// Finds the places of corrections among values in storage order: a correction belongs to the place
/// of the value that it replaces, of the first value in a chain of corrections.
class CorrectedPlaces {
 public:
  /// Adds a correction and its target, in any order; all of them before the first value.
  void add(std::int64_t id, std::int64_t correction_of) {
    corrections_.push_back({id, correction_of});
  }
  void finish_adding() {
    std::ranges::sort(corrections_, {}, &Correction::id);
    // A corrected record was stored earlier, so that its chain is followed already.
    for (auto correction = corrections_.begin(); correction != corrections_.end(); ++correction) {
      const auto earlier = std::ranges::lower_bound(corrections_.begin(), correction,
                                                    correction->replaced, {}, &Correction::id);
      if (earlier != correction && earlier->id == correction->replaced) {
        correction->replaced = earlier->replaced;
      }
      places_.push_back({.replaced = correction->replaced});
    }
    std::ranges::sort(places_, {}, &Place::replaced);
  }

  /// Adds the id of the next value, which must be larger than the previous id.
  void pass(std::int64_t id) {
    for (; next_place_ < places_.size() && places_[next_place_].replaced < id; ++next_place_) {
      places_[next_place_].index = passed_;
    }
    while (next_correction_ < corrections_.size() && corrections_[next_correction_].id < id) {
      ++next_correction_;
    }
    if (next_correction_ < corrections_.size() && corrections_[next_correction_].id == id) {
      seen_.push_back({passed_, corrections_[next_correction_].replaced});
    }
    ++passed_;
  }

  /// Returns the moved values in the order of their places.
  std::vector<MovedValue> moves() const {
    std::vector<Seen> ordered = seen_;
    std::ranges::stable_sort(ordered, {}, &Seen::replaced);
    std::vector<MovedValue> moves;
    moves.reserve(ordered.size());
    for (const Seen& value : ordered) {
      const auto place = std::ranges::lower_bound(places_, value.replaced, {}, &Place::replaced);
      moves.push_back({.from = value.index, .to = place->index});
    }
    return moves;
  }

 private:
  struct Correction {
    std::int64_t id = 0;
    std::int64_t replaced = 0;  ///< the first row of its chain
  };
  struct Place {
    std::int64_t replaced = 0;
    std::size_t index = 0;
  };
  struct Seen {
    std::size_t index = 0;
    std::int64_t replaced = 0;
  };

  std::vector<Correction> corrections_;  // by id
  std::vector<Place> places_;            // by what is replaced
  std::vector<Seen> seen_;               // corrections among the values
  std::size_t next_correction_ = 0;
  std::size_t next_place_ = 0;
  std::size_t passed_ = 0;
};

class MeasurementQueue;

/// A response that can be stored under an idempotency key and replayed.
using Answer = store::StoredAnswer;

/// The identity of a request.
struct IdempotencyScope {
  std::string caller;
  std::string method;
  std::string path;
  std::string key;
  std::string_view body;          ///< alive until the answer
  bool is_kept_for_ever = false;  ///< not only for the days of the service
};

/// Selects the measurements of a list.
struct MeasurementQuery : store::MeasurementFilter {
  bool newest_first = false;
  bool shows_notes = false;
  bool shows_first_rows = false;
  std::optional<std::size_t> last;  ///< only this number of the newest matches, on one page
  std::optional<RecordName> after;  ///< begins after this record, in place of a cursor
};

/// Continuation of a list after a page.
struct ListPage {
  std::optional<std::int64_t> next;  ///< last row of the page; none after the last page
  std::int64_t as_of = 0;            ///< the state all pages of the list are read in
};

/// The input of figures. The text is valid during the visitor's call.
struct MeasuredRun {
  struct Value {
    std::int64_t id = 0;
    Length measured;
  };

  std::string_view origin{};  ///< their origins; must outlive the run
  std::optional<Length> lower_limit;
  std::optional<Length> upper_limit;
  std::optional<std::string_view> subgroup;
  std::span<const Value> values{};
};

/// Facts of values after all of them are read.
struct ReadValues {
  std::string as_of;              ///< the id of the newest measurement there was
  std::vector<MovedValue> moves;  ///< moves corrections to the places of their targets
};

/// Number of measurements for each gauging::Verdict.
using VerdictTally = std::array<std::int64_t, gauging::kVerdicts>;
using MeasurementGroup = store::SummaryGroup;

struct MeasurementServiceOptions {
  std::size_t most_waiting = 4096;  ///< requests; one more is StorageBusy
  bool commit_each = false;         ///< one commit for each request: the benchmark's peer
};

/// Makes the answer to a request from its measurements, which may come in pieces. Used by one
/// thread.
class Rendering {
 public:
  Rendering& operator=(Rendering&&) = delete;  // neither copied nor moved
  virtual ~Rendering() = default;

  /// Adds measurements with their ids.
  /// @param records their stored JSON, separated by commas.
  virtual void add(std::span<const Measurement> measurements, std::string_view records) = 0;
  virtual Answer finish() = 0;
};

/// Stores and reads measurements. Functions do not block unless documented; `done` is called
/// exactly once, on a storage thread or, if refused at once, on the caller's. Thread-safe.
class MeasurementService : Records {
 public:
  MeasurementService(const Records& records, const MeasurementServiceOptions& options);

  /// @errors MeasurementUnknown.
  Result<RecordName> parse_id(std::string_view text) const {
    return parse_measurement_id(text, origins_);
  }
  /// @errors RunUnknown.
  Result<RecordName> parse_run(std::string_view text) const { return parse_run_id(text, origins_); }

  /// Begins an answer; called on the writer thread, and again if the store is repeated.
  using Render = std::function<std::unique_ptr<Rendering>()>;

  /// Returns the stored response to this request, or none. @errors IdempotencyKeyReused,
  /// StorageUnavailable.
  void find_answer(const IdempotencyScope& scope, Done<std::optional<Answer>> done);

  /// Stores judged measurements, all or none; `done` comes when they are durable. The texts of the
  /// measurements stay alive until then.
  /// @param scope keeps the answer for repeats, in the same transaction.
  /// @errors StorageUnavailable, StorageBusy, IdempotencyKeyReused, IdempotencyInProgress,
  ///   MeasurementUnknown and MeasurementCorrected of a correction.
  void record(std::vector<Measurement> measurements, const std::optional<IdempotencyScope>& scope,
              Render render, Done<Answer> done);

  /// Receives the next measurements of a request.
  using Take = std::function<void(std::vector<Measurement>)>;
  /// Reads a request to its end, at least one measurement or an error. After an error nothing is
  /// stored.
  using Read = std::function<Result<void>(const Take&)>;

  /// Stores judged measurements while `read` continues, all or none. Blocks until they are durable.
  /// The texts of the measurements must live until it returns.
  /// @errors those of `read` and of record().
  Result<Answer> record_while_reading(const Read& read,
                                      const std::optional<IdempotencyScope>& scope,
                                      Rendering& rendering);

  /// Called on a reader thread; the measurement's texts are valid during the call.
  using Visitor = std::function<void(const Measurement&)>;

  /// Visits one measurement; `corrected_by` is set if it was corrected. @returns its place in this
  /// folder. @errors MeasurementUnknown.
  void find(const RecordName& name, Visitor visit, Done<std::int64_t> done);

  /// Stores a note on a measurement. @param note has its time
  /// @errors MeasurementUnknown, and those of record().
  void add_note(const RecordName& name, Note note, const std::optional<IdempotencyScope>& scope,
                Done<Answer> done);

  /// Returns the notes on a measurement, oldest first. @errors MeasurementUnknown.
  void list_notes(const RecordName& name, Done<std::vector<Note>> done);

  /// Visits up to `limit` matching measurements after the cursor `after`, in storage order or
  /// reversed. A query without `as_of_id` reads the newest state and returns its id; later pages
  /// name it, so that the whole list shows one state, whatever is stored in between.
  void list(const MeasurementQuery& query, std::int64_t after, std::size_t limit, Visitor visit,
            Done<ListPage> done);

  /// Visits the values that figures need, for all matching measurements, in storage order and in
  /// one state. Ends with the first error of the visitor. Blocks.
  /// @errors StorageBusy, StorageUnavailable, ShuttingDown
  using RunVisitor = std::function<Result<void>(const MeasuredRun&)>;
  Result<ReadValues> read_values(const MeasurementQuery& query, const RunVisitor& visit);

  /// Groups by one of kTextFilters. @errors QueryInvalid for another field or too many groups.
  void summary(const MeasurementQuery& query, std::string_view group_by,
               Done<std::vector<MeasurementGroup>> done);

 private:
  template <class Work>
  void submit(const std::optional<IdempotencyScope>& scope, Work work, Done<Answer> done);

  const std::shared_ptr<MeasurementQueue> queue_;  ///< shared with its jobs
};

}  // namespace fitgauge::app

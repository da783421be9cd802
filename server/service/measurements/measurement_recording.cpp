#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "record/measurement.hpp"
#include "record/note.hpp"
#include "service/measurements/measurement_storage.hpp"

namespace fitgauge::app {

// Storing of measurements; measurement_service.cpp reads them.

/// Queue of small requests for the writer. One job stores all requests that arrive before it begins
/// and fit: their rows fill the same statements, and one savepoint is enough. Thread-safe. Each job
/// owns a reference to the queue, so the queue outlives them; the database runs its jobs when it
/// closes.
class MeasurementQueue : public std::enable_shared_from_this<MeasurementQueue> {
 public:
  /// @param origin of the data folder.
  /// @param most_waiting requests; one more is StorageBusy.
  /// @param each_apart every request is a separate job and commit.
  MeasurementQueue(Database& database, std::string_view origin, std::size_t most_waiting,
                   bool each_apart)
      : database_(database),
        origin_(origin),
        most_waiting_(most_waiting),
        each_apart_(each_apart) {}

  using Render = MeasurementService::Render;

  /// Records like MeasurementService::record, for measurements that correct none.
  void record(std::span<const Measurement> measurements, Render render, Done<Answer> done) {
    std::unique_lock lock(mutex_);
    if (waiting_ >= most_waiting_) {
      lock.unlock();
      return done(too_much_work());
    }
    const bool joins = open_ && !each_apart_ && open_->measurements.size() < kRowsAtATime;
    const std::shared_ptr<Load> load = joins    ? open_
                                       : spare_ ? std::exchange(spare_, nullptr)
                                                : std::make_shared<Load>();
    load->add(measurements, std::move(render), std::move(done));
    ++waiting_;
    open_ = load;
    lock.unlock();
    if (!joins) submit(load);
  }

 private:
  struct Request {
    std::size_t first;  ///< of its measurements in the load
    std::size_t count;
    Render render;
    Done<Answer> done;
    Answer answer{};
  };
  /// The rows of one job: kRowsAtATime measurements, and the rest of the last request.
  struct Load {
    Load() { requests.reserve(kRowsAtATime); }
    /// All or nothing: there is room for another request.
    void add(std::span<const Measurement> rows, Render render, Done<Answer> done) {
      const std::size_t first = measurements.size();
      measurements.insert(measurements.end(), rows.begin(), rows.end());
      requests.push_back({first, rows.size(), std::move(render), std::move(done), {}});
    }
    std::span<Measurement> of(const Request& request) {
      return std::span(measurements).subspan(request.first, request.count);
    }

    std::vector<Measurement> measurements;
    std::vector<Request> requests;
    bool is_closed = false;
  };

  void submit(const std::shared_ptr<Load>& load) {
    database_.writer().submit(
        [self = shared_from_this(), load](Stores& stores) -> Result<bool> {
          self->close(load);
          return self->store(stores, *load);
        },
        [self = shared_from_this(), load](const Result<bool>& stored) {
          self->close(load);  // a refused job has not begun
          self->finish(*load, stored);
          self->keep(load);
        });
  }
  /// No further request joins.
  void close(const std::shared_ptr<Load>& load) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(load->is_closed, true)) waiting_ -= load->requests.size();
    if (open_ == load) open_ = nullptr;
  }
  /// Reused by the next job: memory that one thread allocates and another frees is slow.
  void keep(const std::shared_ptr<Load>& load) {
    load->measurements.clear();
    load->requests.clear();
    load->is_closed = false;
    const std::lock_guard lock(mutex_);
    spare_ = load;
  }
  Result<bool> store(Stores& stores, Load& load) {
    rows_.clear();
    number_from(stores.measurements.last_id() + 1, origin_, load.measurements);
    append_rows(rows_, load.measurements, leaves_);
    for (Request& request : load.requests) {
      const auto rendering = request.render();
      rendering->add(load.of(request), leaves_.records(request.first, request.count));
      request.answer = rendering->finish();
    }
    TRY(stores.measurements.append(rows_));
    return true;
  }
  /// A bug may be in one request only: then the others are stored.
  void finish(Load& load, const Result<bool>& stored) {
    const bool again =
        !stored && stored.error().code == ErrorCode::Internal && load.requests.size() > 1;
    for (Request& request : load.requests) {
      guarded("the end of a measurement's request", [&] {
        if (again) {
          const auto alone = std::make_shared<Load>();
          alone->is_closed = true;  // no other request joins, and it was counted
          alone->add(load.of(request), std::move(request.render), std::move(request.done));
          submit(alone);
        } else if (stored) {
          request.done(std::move(request.answer));
        } else {
          request.done(stored.error());
        }
      });
    }
  }

  Database& database_;
  const std::string_view origin_;
  const std::size_t most_waiting_;
  const bool each_apart_;
  LeafMaker leaves_;                  ///< of the writer thread
  std::vector<MeasurementRow> rows_;  ///< rows of one job; used by the writer thread
  std::mutex mutex_;
  std::size_t waiting_ = 0;      ///< requests whose jobs have not begun
  std::shared_ptr<Load> open_;   ///< the last job that has not begun, or null
  std::shared_ptr<Load> spare_;  ///< empty, with the memory of a stored job
};

namespace {

/// The measurements of one long request on their way from the thread that reads them to the writer,
/// which stores the first ones while the last are still being read. Owns the pieces under way.
/// Work without the database is done on the reading side: it numbers the rows and makes
/// their leaves itself.
/// Thread-safe; each side is one thread. The reading side stops waiting when the outcome is there,
/// the writer after finish() or fail().
class MeasurementFeed {
 public:
  /// Numbers continue from earlier rows; their texts must live until outcome() has returned.
  using Piece = std::vector<MeasurementRow>;

  // The reading side.

  /// Waits for the writer's turn. @returns the id before the first row; none if the writer ended
  /// without beginning.
  std::optional<std::int64_t> last_id() {
    std::unique_lock lock(mutex_);
    wait(lock, [this] { return last_id_.has_value(); });
    return last_id_;
  }
  /// Hands a piece over; waits while a few are under way already.
  void put(Piece piece) {
    std::unique_lock lock(mutex_);
    wait(lock, [this] { return pieces_.size() < kMostPieces; });
    pieces_.push_back(std::move(piece));
    changed_.notify_all();
  }
  /// Ends the rows. @param answer to store, if the request has an idempotency key.
  void finish(Answer answer) {
    change([&] { answer_ = std::move(answer); });
  }
  /// Refuses the request and stores nothing of it.
  void fail(Error error) {
    change([&] { error_ = std::move(error); });
  }
  /// Waits until the writer is done.
  Result<Answer> outcome() {
    std::unique_lock lock(mutex_);
    wait(lock, [] { return false; });
    return *std::move(outcome_);
  }

  // The writer's side.

  void begin(std::int64_t last_id) {
    change([&] { last_id_ = last_id; });
  }
  /// The next piece, empty after the last. @errors that of fail().
  Result<Piece> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !pieces_.empty() || answer_ || error_; });
    if (error_) return *error_;
    if (pieces_.empty()) return Piece();
    Piece piece = std::move(pieces_.front());
    pieces_.pop_front();
    changed_.notify_all();
    return piece;
  }
  Answer take_answer() { return std::move(*answer_); }
  void end(Result<Answer> outcome) {
    change([&] { outcome_.emplace(std::move(outcome)); });
  }

 private:
  static constexpr std::size_t kMostPieces = 4;

  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, Condition condition) {
    changed_.wait(lock, [&] { return outcome_.has_value() || condition(); });
  }
  template <class Change>
  void change(Change change) {
    const std::lock_guard lock(mutex_);
    change();
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Piece> pieces_;
  std::optional<std::int64_t> last_id_;
  std::optional<Answer> answer_;
  std::optional<Error> error_;
  std::optional<Result<Answer>> outcome_;
};

/// Stores the pieces of a long request, from the thread that reads it.
Result<Answer> append_pieces(Stores& stores, MeasurementFeed& feed) {
  feed.begin(stores.measurements.last_id());
  while (true) {
    const auto piece = TRY(feed.take());
    if (piece.empty()) return feed.take_answer();
    TRY(stores.measurements.append(piece));
  }
}

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, fmt::format("reading a request failed: {}", bug.what())};
}

}  // namespace

MeasurementService::MeasurementService(const Records& records,
                                       const MeasurementServiceOptions& options)
    : Records(records),
      queue_(std::make_shared<MeasurementQueue>(database_, origins_.own(), options.most_waiting,
                                                options.commit_each)) {}

void MeasurementService::find_answer(const IdempotencyScope& scope,
                                     Done<std::optional<Answer>> done) {
  database_.readers().submit(
      // The thread that asks must not digest a long body.
      [scope](const Stores& stores) { return stores.idempotency.find(to_store(scope)); },
      std::move(done));
}

template <class Work>
void MeasurementService::submit(const std::optional<IdempotencyScope>& scope, Work work,
                                Done<Answer> done) {
  if (scope) {
    database_.writer().submit_once(to_store(*scope), std::move(work), std::move(done));
  } else {
    database_.writer().submit(std::move(work), std::move(done));
  }
}

void MeasurementService::record(std::vector<Measurement> measurements,
                                const std::optional<IdempotencyScope>& scope, Render render,
                                Done<Answer> done) {
  number_revisions(measurements, tables_);
  const bool is_small = measurements.size() <= kRowsAtATime;
  if (is_small && !scope && !measurements.front().correction_of) {
    return queue_->record(measurements, std::move(render), std::move(done));
  }
  auto work = [measurements = std::move(measurements), origin = origins_.own(),
               render = std::move(render)](Stores& stores) mutable -> Result<Answer> {
    const auto rendering = render();
    TRY(append(stores, measurements, origin, rendering.get()));
    return rendering->finish();
  };
  submit(scope, std::move(work), std::move(done));
}

void MeasurementService::add_note(const RecordName& name, Note note,
                                  const std::optional<IdempotencyScope>& scope, Done<Answer> done) {
  auto work = [this, name, note = std::move(note)](Stores& stores) mutable -> Result<Answer> {
    const auto row = TRY(existing_row_of(stores, name, origins_));
    note.measurement = measurement_id_text(name.number, origins_.digits(name.origin, name.number));
    append_note(stores, row, origins_, note, note.received_at.nanoseconds);
    return Answer{.status = 201,
                  .content_type = "application/json",
                  .location = {},
                  .body = api::body_json(note)};
  };
  submit(scope, std::move(work), std::move(done));
}

Result<Answer> MeasurementService::record_while_reading(
    const Read& read, const std::optional<IdempotencyScope>& scope, Rendering& rendering) {
  const auto feed = std::make_shared<MeasurementFeed>();
  std::optional<std::int64_t> next_id;
  LeafMaker leaves;
  const auto begin = [&] {
    submit(
        scope, [feed](Stores& stores) { return append_pieces(stores, *feed); },
        [feed](Result<Answer> outcome) { feed->end(std::move(outcome)); });
    if (const auto last_id = feed->last_id()) next_id = *last_id + 1;
  };
  bool begun = false;
  const auto take = [&](std::vector<Measurement> measurements) {
    if (!std::exchange(begun, true)) begin();
    if (!next_id) return;  // refused before a row was stored
    number_revisions(measurements, tables_);
    next_id = number_from(*next_id, origins_.own(), measurements);
    MeasurementFeed::Piece piece;
    piece.reserve(measurements.size());
    append_rows(piece, measurements, leaves);
    feed->put(std::move(piece));
    rendering.add(measurements, leaves.records());
  };
  Result<void> complete;
  try {
    complete = read(take);
    if (complete && next_id) feed->finish(rendering.finish());
  } catch (const std::exception& bug) {
    complete = internal_error(bug);
  }
  if (!begun) return complete.error();
  if (!complete) feed->fail(complete.error());
  return feed->outcome();
}

}  // namespace fitgauge::app

#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "db/store/measurement_row.hpp"
#include "service/log/leaf.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/measurements/measurement_storage.hpp"

namespace fitgauge::app {

/// Where small requests wait for the writer. All that come before its job begins and have room in
/// it are stored by that one: their rows fill the same statements, and one savepoint serves them
/// all. Thread-safe.
/// Each job owns a reference to the queue, so the queue outlives them; the database drains its jobs
/// when it closes.
class MeasurementQueue : public std::enable_shared_from_this<MeasurementQueue> {
 public:
  /// @param origin of the data folder.
  /// @param most_waiting requests; one more is StorageBusy.
  /// @param each_apart every request is a job, and so a commit, of its own.
  MeasurementQueue(store::Database& database, std::string_view origin, std::size_t most_waiting,
                   bool each_apart)
      : database_(database),
        origin_(origin),
        most_waiting_(most_waiting),
        each_apart_(each_apart) {}

  template <class T>
  using Done = MeasurementService::Done<T>;
  using Render = MeasurementService::Render;

  /// As MeasurementService::record, of measurements that correct none.
  void record(std::span<const Measurement> measurements, Render render, Done<Answer> done);

 private:
  struct Request {
    std::size_t first;  ///< of its measurements in the load
    std::size_t count;
    Render render;
    Done<Answer> done;
    Answer answer{};
  };
  /// What one job stores: kRowsAtATime measurements, and what the last request has beyond.
  struct Load {
    Load() { requests.reserve(kRowsAtATime); }
    void add(std::span<const Measurement> rows, Render render, Done<Answer> done);
    std::span<Measurement> of(const Request& request) {
      return std::span(measurements).subspan(request.first, request.count);
    }

    std::vector<Measurement> measurements;
    std::vector<Request> requests;
    bool is_closed = false;
  };

  void submit(const std::shared_ptr<Load>& load);
  void close(const std::shared_ptr<Load>& load);
  void keep(const std::shared_ptr<Load>& load);
  Result<bool> store(store::Stores& stores, Load& load);
  void finish(Load& load, const Result<bool>& stored);

  store::Database& database_;
  const std::string_view origin_;
  const std::size_t most_waiting_;
  const bool each_apart_;
  LeafMaker leaves_;                         ///< of the writer thread
  std::vector<store::MeasurementRow> rows_;  ///< those of one job, of the writer thread
  std::mutex mutex_;
  std::size_t waiting_ = 0;      ///< requests whose jobs have not begun
  std::shared_ptr<Load> open_;   ///< the last whose job has not begun; null when there is none
  std::shared_ptr<Load> spare_;  ///< empty, with the memory of one that was stored
};

/// The measurements of one long request on their way from the thread that reads them to the writer,
/// which stores the first ones while the last are still being read. Owns the pieces under way.
/// Whatever needs no database is done on the reading side: it numbers the rows and makes
/// their leaves itself.
/// Thread-safe; each side is one thread. The reading side stops waiting when the outcome is there,
/// the writer after finish() or fail().
class MeasurementFeed {
 public:
  /// Numbered on from what was put before; their texts live until outcome() has returned.
  using Piece = std::vector<store::MeasurementRow>;

  // The reading side.

  /// Waits for the writer's turn. @returns the id before that of the first row; none when the
  /// writer is done without having begun.
  std::optional<std::int64_t> last_id();
  /// Hands a piece over; waits while a few are under way already.
  void put(Piece piece);
  /// There is nothing more. @param answer to be kept, when the request has an idempotency key.
  void finish(Answer answer);
  /// The request is refused: nothing of it is kept.
  void fail(Error error);
  /// Waits until the writer is done.
  Result<Answer> outcome();

  // The writer's side.

  void begin(std::int64_t last_id);
  /// The next piece, empty after the last. @errors that of fail().
  Result<Piece> take();
  Answer take_answer() { return std::move(*answer_); }
  void end(Result<Answer> outcome);

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

}  // namespace fitgauge::app

#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "db/store/measurement_row.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::app {

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

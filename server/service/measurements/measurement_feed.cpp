#include "service/measurements/measurement_feed.hpp"

namespace fitgauge::app {

std::optional<std::int64_t> MeasurementFeed::last_id() {
  std::unique_lock lock(mutex_);
  wait(lock, [this] { return last_id_.has_value(); });
  return last_id_;
}

void MeasurementFeed::put(Piece piece) {
  std::unique_lock lock(mutex_);
  wait(lock, [this] { return pieces_.size() < kMostPieces; });
  pieces_.push_back(std::move(piece));
  changed_.notify_all();
}

void MeasurementFeed::finish(Answer answer) {
  change([&] { answer_ = std::move(answer); });
}

void MeasurementFeed::fail(Error error) {
  change([&] { error_ = std::move(error); });
}

Result<Answer> MeasurementFeed::outcome() {
  std::unique_lock lock(mutex_);
  wait(lock, [] { return false; });
  return *std::move(outcome_);
}

void MeasurementFeed::begin(std::int64_t last_id) {
  change([&] { last_id_ = last_id; });
}

Result<MeasurementFeed::Piece> MeasurementFeed::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !pieces_.empty() || answer_ || error_; });
  if (error_) return *error_;
  if (pieces_.empty()) return Piece();
  Piece piece = std::move(pieces_.front());
  pieces_.pop_front();
  changed_.notify_all();
  return piece;
}

void MeasurementFeed::end(Result<Answer> outcome) {
  change([&] { outcome_.emplace(std::move(outcome)); });
}

}  // namespace fitgauge::app

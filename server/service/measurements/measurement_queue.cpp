#include "service/measurements/measurement_queue.hpp"

#include "base/thread.hpp"
#include "db/store/database.hpp"

namespace fitgauge::app {

/// All or nothing: there is room for another request.
void MeasurementQueue::Load::add(std::span<const Measurement> rows, Render render,
                                 Done<Answer> done) {
  const std::size_t first = measurements.size();
  measurements.insert(measurements.end(), rows.begin(), rows.end());
  requests.push_back({first, rows.size(), std::move(render), std::move(done), {}});
}

void MeasurementQueue::record(std::span<const Measurement> measurements, Render render,
                              Done<Answer> done) {
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

void MeasurementQueue::submit(const std::shared_ptr<Load>& load) {
  database_.writer().submit(
      [self = shared_from_this(), load](store::Stores& stores) -> Result<bool> {
        self->close(load);
        return self->store(stores, *load);
      },
      [self = shared_from_this(), load](const Result<bool>& stored) {
        self->close(load);  // when the job was refused, it has not begun
        self->finish(*load, stored);
        self->keep(load);
      });
}

/// No request joins any more.
void MeasurementQueue::close(const std::shared_ptr<Load>& load) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(load->is_closed, true)) waiting_ -= load->requests.size();
  if (open_ == load) open_ = nullptr;
}

/// For the next job: memory that one thread takes and another gives back costs the allocator most.
void MeasurementQueue::keep(const std::shared_ptr<Load>& load) {
  load->measurements.clear();
  load->requests.clear();
  load->is_closed = false;
  const std::lock_guard lock(mutex_);
  spare_ = load;
}

Result<bool> MeasurementQueue::store(store::Stores& stores, Load& load) {
  rows_.clear();
  number_from(stores.measurements.last_id() + 1, origin_, load.measurements);
  append_rows(rows_, load.measurements, leaves_);
  for (Request& request : load.requests) {
    const auto rendering = request.render();
    rendering->add(load.of(request), leaves_.records(request.first, request.count));
    request.answer = rendering->finish();
  }
  const auto appended = stores.measurements.append(rows_);
  if (!appended) return appended.error();
  return true;
}

/// A bug may lie in one request alone: then the others do not suffer for it.
void MeasurementQueue::finish(Load& load, const Result<bool>& stored) {
  const bool again =
      !stored && stored.error().code == ErrorCode::Internal && load.requests.size() > 1;
  for (Request& request : load.requests) {
    guarded("the end of a measurement's request", [&] {
      if (again) {
        const auto alone = std::make_shared<Load>();
        alone->is_closed = true;  // none joins, and it was counted
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

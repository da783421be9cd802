#include "app/measurements/measurement_queue.hpp"

#include <utility>

#include "app/measurements/measurement_storage.hpp"
#include "base/guarded.hpp"
#include "store/database.hpp"

namespace fitgauge::app {
namespace {

Result<bool> store_all(store::Stores& stores, std::string_view origin, LeafMaker& leaves,
                       std::vector<MeasurementQueue::Request>& requests) {
  std::vector<store::MeasurementRow> rows;
  rows.reserve(requests.size());
  std::int64_t id = stores.measurements.last_id() + 1;
  for (auto& request : requests) {
    id = number_from(id, origin, request.measurements);
    append_rows(rows, request.measurements, leaves);
    const auto rendering = request.render();
    rendering->add(request.measurements, leaves.records());
    request.answer = rendering->finish();
  }
  const auto appended = stores.measurements.append(rows);
  if (!appended) return appended.error();
  return true;
}

}  // namespace

void MeasurementQueue::record(Request request) {
  std::unique_lock lock(mutex_);
  if (open_ && open_->size() >= most_waiting_) {
    lock.unlock();
    return request.done(too_much_work());
  }
  const bool begins = open_ == nullptr || each_apart_;
  if (begins) open_ = std::make_shared<Load>();
  open_->push_back(std::move(request));
  const std::shared_ptr<Load> load = begins ? open_ : nullptr;
  lock.unlock();
  if (load) submit(load);
}

void MeasurementQueue::submit(const std::shared_ptr<Load>& load) {
  database_.writer().submit(
      [self = shared_from_this(), load](store::Stores& stores) -> Result<bool> {
        self->close(load);
        return store_all(stores, self->origin_, self->leaves_, *load);
      },
      [self = shared_from_this(), load](const Result<bool>& stored) {
        self->close(load);  // when the job was refused, it has not begun
        self->finish(*load, stored);
      });
}

/// No request joins any more.
void MeasurementQueue::close(const std::shared_ptr<Load>& load) {
  const std::lock_guard lock(mutex_);
  if (open_ == load) open_ = nullptr;
}

/// A bug may lie in one request alone: then the others do not suffer for it.
void MeasurementQueue::finish(Load& load, const Result<bool>& stored) {
  const bool again = !stored && stored.error().code == ErrorCode::Internal && load.size() > 1;
  for (Request& request : load) {
    guarded("the end of a measurement's request", [&] {
      if (again) {
        const auto alone = std::make_shared<Load>();
        alone->push_back(std::move(request));
        submit(alone);
      } else if (stored) {
        request.done(std::move(request.answer));
      } else {
        request.done(stored.error());
      }
    });
  }
}

}  // namespace fitgauge::app

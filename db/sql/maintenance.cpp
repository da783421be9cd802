#include "db/sql/maintenance.hpp"

#include <algorithm>

namespace fitgauge::store {
namespace {

using std::chrono::milliseconds;

/// Rows a step deletes at most: a request that comes in between waits a few milliseconds.
constexpr std::int64_t kStep = 200;
/// Under load a step that took t is followed by so many t of jobs: six percent for maintenance.
constexpr int kShare = 15;
/// After commits, and without any.
constexpr milliseconds kLookInterval{200};
constexpr milliseconds kQuietInterval{60'000};

}  // namespace

bool run_maintenance_step(sql::Session& session, const OpenOptions& options, Timestamp now) {
  using std::chrono::nanoseconds;
  Stores& stores = session.stores();
  const std::int64_t runs_before = now.nanoseconds - nanoseconds(options.run_retention).count();
  session.begin_writing();
  const std::int64_t deleted = stores.idempotency.purge(kStep) +
                               stores.runs.purge(runs_before, kStep) +
                               stores.events.trim(options.event_retention, kStep);
  const bool indexed = stores.measurements.index_step();
  session.commit();
  return deleted > 0 || indexed;
}

void MaintenancePace::stepped(Time begin, Time end, bool more) {
  const auto cost = end - begin;
  has_more_ = more;
  when_quiet_ = more ? end + cost : end + kQuietInterval;
  when_busy_ = more ? end + kShare * cost : end + kQuietInterval;
}

void MaintenancePace::committed(Time now) {
  if (has_more_) return;
  when_quiet_ = std::min(when_quiet_, now + kLookInterval);
  when_busy_ = std::min(when_busy_, now + kLookInterval);
}

milliseconds MaintenancePace::patience(Time now) const {
  return std::max(std::chrono::ceil<milliseconds>(when_quiet_ - now), milliseconds(0));
}

}  // namespace fitgauge::store

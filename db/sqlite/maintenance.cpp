#include "sqlite/maintenance.hpp"

#include <chrono>

namespace fitgauge::store {
namespace {

/// Rows a step deletes at most: a request that comes in between waits a few milliseconds.
constexpr std::int64_t kStep = 200;

}  // namespace

bool tidy(Session& session, const OpenOptions& options, Timestamp now) {
  using std::chrono::nanoseconds;
  Stores& stores = session.stores;
  const std::int64_t runs_before = now.nanoseconds - nanoseconds(options.run_retention).count();
  session.begin_writing.run();
  const std::int64_t deleted = stores.idempotency.purge(kStep) +
                               stores.runs.purge(runs_before, kStep) +
                               stores.events.trim(options.event_retention, kStep);
  const bool indexed = stores.measurements.index_block();
  session.commit.run();
  return deleted > 0 || indexed;
}

}  // namespace fitgauge::store

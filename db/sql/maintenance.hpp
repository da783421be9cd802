#pragma once

#include <chrono>

#include "base/clock.hpp"
#include "db/sql/session.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Does one step of what requests leave behind: deletes some expired answers, old runs and events,
/// indexes the next blocks of measurements. One transaction of some milliseconds.
/// @returns whether there is more to do.
bool run_maintenance_step(sql::Session& session, const OpenOptions& options, Timestamp now);

/// When the writer takes its next maintenance step: at once while it has nothing else to do, and
/// under any load after kShare times what the last step took. Used by the writer's thread.
class MaintenancePace {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// A step that took from `begin` to `end`. @param more whether it left work.
  void stepped(Time begin, Time end, bool more);
  /// Jobs were committed: there may be something to do before the next daily round.
  void committed(Time now);

  /// How long to wait for jobs before the next step.
  std::chrono::milliseconds patience(Time now) const;
  /// Whether a step is due although jobs keep coming.
  bool is_due(Time now) const { return now >= when_busy_; }

 private:
  bool has_more_ = false;
  Time when_quiet_{};
  Time when_busy_{};
};

}  // namespace fitgauge::store

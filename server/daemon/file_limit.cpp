#include "daemon/file_limit.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace fitgauge::daemon {

namespace {
/// For the database with its readers, the listeners, timers and the log.
constexpr rlim_t kOtherFiles = 256;
}  // namespace

std::int64_t allow_connections(std::int64_t connections) {
  const rlim_t needed = static_cast<rlim_t>(connections) + kOtherFiles;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return connections;
  if (limit.rlim_cur < needed) {
    // RLIM_INFINITY is the largest value there is.
    rlimit raised = limit;
    raised.rlim_cur = std::min(needed, limit.rlim_max);
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  if (limit.rlim_cur >= needed) return connections;
  const rlim_t left = limit.rlim_cur > kOtherFiles ? limit.rlim_cur - kOtherFiles : 1;
  return static_cast<std::int64_t>(std::min(left, static_cast<rlim_t>(connections)));
}

}  // namespace fitgauge::daemon

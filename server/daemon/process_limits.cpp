#include "daemon/process_limits.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace fitgauge::daemon {
namespace {

/// The bodies of usual requests are smaller and pay nothing.
constexpr int kLargeBlock = 1 << 20;
/// As many as the C library allows by itself. It would count the processors in the middle of a
/// run, and open a file for that.
constexpr long kArenasOfAProcessor = 8;

/// For the database with its readers, the listeners, timers and the log.
constexpr rlim_t kOtherFiles = 256;

}  // namespace

void give_large_blocks_back() {
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
  mallopt(M_ARENA_MAX, static_cast<int>(kArenasOfAProcessor * sysconf(_SC_NPROCESSORS_ONLN)));
}

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

#include "daemon/memory.hpp"

#include <malloc.h>
#include <unistd.h>

namespace fitgauge::daemon {

namespace {
/// The bodies of usual requests are smaller and pay nothing.
constexpr int kLargeBlock = 1 << 20;
/// As many as the C library allows by itself. It would count the processors in the middle of a
/// run, and open a file for that.
constexpr long kArenasOfAProcessor = 8;
}  // namespace

void give_large_blocks_back() {
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
  mallopt(M_ARENA_MAX, static_cast<int>(kArenasOfAProcessor * sysconf(_SC_NPROCESSORS_ONLN)));
}

}  // namespace fitgauge::daemon

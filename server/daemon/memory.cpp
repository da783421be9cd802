#include "daemon/memory.hpp"

#include <malloc.h>

namespace fitgauge::daemon {

namespace {
/// The bodies of usual requests are smaller and pay nothing.
constexpr int kLargeBlock = 1 << 20;
}  // namespace

void give_large_blocks_back() { mallopt(M_MMAP_THRESHOLD, kLargeBlock); }

}  // namespace fitgauge::daemon

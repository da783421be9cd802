#pragma once

#include <cstdint>

namespace fitgauge {

/// Bytes that the calling thread has taken with `new` less those it has given back, since it
/// began. The program's operators new and delete keep this count, so no container can be
/// forgotten, and what the allocator keeps beside each piece is counted with it. Memory that
/// another thread gives back is counted there.
std::int64_t thread_memory();

/// Adds to the calling thread's count: `bytes` that another thread has taken and this one is to
/// give back, or, negative, the other way round.
void hand_over_memory(std::int64_t bytes);

}  // namespace fitgauge

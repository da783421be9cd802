#pragma once

#include <cstdint>

namespace fitgauge {

/// Bytes that the calling thread has taken with `new` less those it has given back, since it
/// began. The program's operators new and delete keep this count, so no container can be
/// forgotten; memory that another thread gives back is counted there.
std::int64_t thread_memory();

}  // namespace fitgauge

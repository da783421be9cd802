#pragma once

namespace fitgauge::daemon {

/// From now on the C library takes a large block from the kernel by itself and gives it back as
/// soon as it is freed. Left alone it learns from the first large block that such are common, and
/// keeps every later one: a run that has held 48 MiB would leave them behind. Of the whole process.
void give_large_blocks_back();

}  // namespace fitgauge::daemon

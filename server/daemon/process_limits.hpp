#pragma once

#include <cstdint>

namespace fitgauge::daemon {

/// From now on the C library takes a large block from the kernel by itself and gives it back as
/// soon as it is freed. Left alone it learns from the first large block that such are common, and
/// keeps every later one: a run that has held 48 MiB would leave them behind. Of the whole process.
void give_large_blocks_back();

/// Raises the soft limit of open files, to the hard limit at most, so that `connections` can
/// be open beside the files of the database and the log. Shells and systemd begin with 1024.
/// @returns how many connections can be open then.
std::int64_t allow_connections(std::int64_t connections);

}  // namespace fitgauge::daemon

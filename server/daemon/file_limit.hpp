#pragma once

#include <cstdint>

namespace fitgauge::daemon {

/// Raises the soft limit of open files, to the hard limit at most, so that `connections` can
/// be open beside the files of the database and the log. Shells and systemd begin with 1024.
/// @returns how many connections can be open then.
std::int64_t allow_connections(std::int64_t connections);

}  // namespace fitgauge::daemon

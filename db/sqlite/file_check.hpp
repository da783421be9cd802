#pragma once

#include <filesystem>
#include <stop_token>

#include "base/result.hpp"

namespace fitgauge::store {

/// Runs SQLite's quick_check over a file through a read-only connection, which leaves it untouched.
/// Ends without a finding when it is stopped.
/// @errors StorageCorrupt with the first damage found.
Result<void> check_file(const std::filesystem::path& file, std::stop_token stop = {});

}  // namespace fitgauge::store

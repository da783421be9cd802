#pragma once

#include <filesystem>

#include "base/folder.hpp"
#include "base/result.hpp"

namespace fitgauge {

/// Opens a regular file to read, also by a link. Never blocks: a FIFO or a device is refused.
/// @errors StorageUnavailable with the cause alone.
Result<Descriptor> open_regular(const std::filesystem::path& file);

/// The bytes of a regular file, at most 64 MiB. @errors as open_regular().
Result<std::string> read_regular(const std::filesystem::path& file);

/// The rest of an open file. @errors as read_regular().
Result<std::string> read_all(const Descriptor& file);

}  // namespace fitgauge

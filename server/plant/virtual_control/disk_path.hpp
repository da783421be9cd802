#pragma once

#include <string>
#include <string_view>

#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/control_error.hpp"

namespace fitgauge::virtual_control {

inline constexpr std::string_view kRoot = "TNC:\\";

/// A file as a client names it: absolute, or relative to its directory. `/` separates as `\` does.
/// @param directory ends with `\`
/// @errors BadFileName: another drive, a path out of `TNC:\`, no file name.
control_link::ControlResult<interpreter::ControlPath> file_path(std::string_view text,
                                                                std::string_view directory);

/// A directory, with its last `\`; whether it is there is the disk's to say. @errors BadFileName.
control_link::ControlResult<std::string> directory_path(std::string_view text,
                                                        std::string_view directory);

/// The directory that a directory lies in; of the root the root.
std::string_view parent_of(std::string_view directory);

}  // namespace fitgauge::virtual_control

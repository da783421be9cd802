#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/json/field_reader.hpp"

namespace fitgauge::connections {

/// Which folders of this machine a connection may name.
struct FolderPermissions {
  bool all = false;                            ///< it stands in the configuration file
  std::vector<std::filesystem::path> roots{};  ///< else these and what is below them
};

/// Reads a member that is an absolute path of this machine. What is wrong goes to the reader's
/// errors.
std::filesystem::path read_path(std::string_view name, const FolderPermissions& allowed,
                                api::FieldReader& fields);

}  // namespace fitgauge::connections

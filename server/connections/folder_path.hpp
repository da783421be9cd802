#pragma once

#include <filesystem>
#include <vector>

#include "api/wire/field_reader.hpp"

namespace fitgauge::connections {

/// Which folders of this machine a connection may name.
struct FolderPermissions {
  bool all = false;                            ///< it stands in the configuration file
  std::vector<std::filesystem::path> roots{};  ///< else these and what is below them
};

/// Reads the member `folder`: an absolute path. What is wrong goes to the reader's errors.
std::filesystem::path read_folder(api::FieldReader& fields, const FolderPermissions& allowed);

}  // namespace fitgauge::connections

#include "connections/folder_path.hpp"

#include <algorithm>

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;

/// With the links of what is there followed.
bool is_below(const fs::path& folder, const fs::path& root) {
  std::error_code failure;
  const fs::path inner = fs::weakly_canonical(folder, failure);
  const fs::path outer = fs::weakly_canonical(root, failure);
  if (failure) return false;
  const auto [end, rest] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

}  // namespace

fs::path read_folder(api::FieldReader& fields, const FolderPermissions& allowed) {
  const auto text = fields.text("folder");
  if (!text) return {};
  const fs::path folder(*text);
  const bool climbs =
      std::any_of(folder.begin(), folder.end(), [](const fs::path& part) { return part == ".."; });
  if (!folder.is_absolute() || climbs || text->find('\0') != std::string::npos) {
    fields.report(ErrorCode::FieldInvalid, "folder",
                  "a folder is an absolute path without .., such as /srv/measurements/in");
    return {};
  }
  const bool is_allowed =
      allowed.all || std::any_of(allowed.roots.begin(), allowed.roots.end(),
                                 [&](const fs::path& root) { return is_below(folder, root); });
  if (!is_allowed) {
    fields.report(ErrorCode::FieldInvalid, "folder",
                  allowed.roots.empty()
                      ? "no folder may be named over HTTP: set connection_folders in the "
                        "configuration of the service, or write the connection into its file"
                      : "the folder is not below those of connection_folders in the configuration "
                        "of the service");
  }
  return folder;
}

}  // namespace fitgauge::connections

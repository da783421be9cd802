#include "plant/folder/folder_path.hpp"

#include <fmt/format.h>

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

fs::path read_path(std::string_view name, const FolderPermissions& allowed,
                   api::FieldReader& fields) {
  const auto text = fields.text(name);
  if (!text) return {};
  const fs::path path(*text);
  const bool climbs =
      std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (!path.is_absolute() || climbs || text->find('\0') != std::string::npos) {
    fields.report(
        ErrorCode::FieldInvalid, name,
        fmt::format("{} is an absolute path without .., such as /srv/measurements", name));
    return {};
  }
  const bool is_allowed =
      allowed.all || std::any_of(allowed.roots.begin(), allowed.roots.end(),
                                 [&](const fs::path& root) { return is_below(path, root); });
  if (!is_allowed) {
    fields.report(ErrorCode::FieldInvalid, name,
                  allowed.roots.empty()
                      ? "no path may be named over HTTP: set connection_folders in the "
                        "configuration of the service, or write the connection into its file"
                      : "it is not below those of connection_folders in the configuration "
                        "of the service");
  }
  return path;
}

}  // namespace fitgauge::connections

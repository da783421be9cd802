#include "plant/virtual_control/disk_path.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace fitgauge::virtual_control {
namespace {

using control_link::ControlError;

std::string absolute(std::string_view text, std::string_view directory) {
  std::string path(text);
  std::replace(path.begin(), path.end(), '/', '\\');
  if (path.find(':') != std::string::npos) return path;
  if (path.starts_with('\\')) return std::string(kRoot.substr(0, 4)) + path;
  return std::string(directory) + path;
}

}  // namespace

control_link::ControlResult<interpreter::ControlPath> file_path(std::string_view text,
                                                                std::string_view directory) {
  auto path = interpreter::ControlPath::parse(absolute(text, directory));
  if (!path) return ControlError::BadFileName;
  return *std::move(path);
}

control_link::ControlResult<std::string> directory_path(std::string_view text,
                                                        std::string_view directory) {
  std::string path = absolute(text, directory);
  while (path.ends_with('\\')) path.pop_back();
  if (ascii_iequals(path, kRoot.substr(0, 4))) return std::string(kRoot);
  const auto parsed = interpreter::ControlPath::parse(path);
  if (!parsed) return ControlError::BadFileName;
  return parsed->text() + "\\";
}

std::string_view parent_of(std::string_view directory) {
  directory.remove_suffix(1);
  const std::string_view parent = directory.substr(0, directory.rfind('\\') + 1);
  return parent.empty() ? kRoot : parent;
}

}  // namespace fitgauge::virtual_control

#include "api/files/file_path.hpp"

#include <string>

#include "base/text.hpp"

namespace fitgauge::api {

Result<interpreter::ControlPath> parse_file_path(std::string_view text) {
  if (ascii_iequals(trim(text).substr(0, kDrive.size()), kDrive) || text.empty()) {
    return interpreter::ControlPath::parse(text);
  }
  if (text.starts_with(kFiles)) text.remove_prefix(kFiles.size());
  return interpreter::ControlPath::parse(std::string(kDrive).append(text));
}

}  // namespace fitgauge::api

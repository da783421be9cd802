#include "plant/lsv2/collector_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace fitgauge::connections {

Result<WatchedPath> parse_watched_path(std::string_view text) {
  std::string path(text);
  std::replace(path.begin(), path.end(), '/', '\\');
  const std::size_t stroke = path.rfind('\\');
  const bool is_path = path.size() > 5 && ascii_iequals(path.substr(0, 5), "TNC:\\") &&
                       stroke + 1 < path.size() && path.find("..") == std::string::npos &&
                       path.find_first_of("*?") >= stroke;
  if (!is_path) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("'{}' is no path to watch: write a folder of TNC:\\ and a file name, "
                             "which may have * and ?, such as TNC:\\nc_prog\\TCHPR*.TXT",
                             text)};
  }
  return WatchedPath{path.substr(0, stroke + 1), path.substr(stroke + 1)};
}

bool matches(const WatchedPath& watched, std::string_view file_name) {
  return matches_glob(watched.name, file_name);
}

}  // namespace fitgauge::connections

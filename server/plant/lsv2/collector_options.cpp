#include "plant/lsv2/collector_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace fitgauge::collector {
namespace {

/// Glob without backtracking beyond the last star: linear in name times stars.
bool glob(std::string_view pattern, std::string_view name) {
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t after = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after = n;
    } else if (p < pattern.size() &&
               (pattern[p] == '?' || ascii_lower(pattern[p]) == ascii_lower(name[n]))) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++after;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

}  // namespace

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
  return glob(watched.name, file_name);
}

}  // namespace fitgauge::collector

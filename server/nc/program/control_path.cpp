#include "nc/program/control_path.hpp"

#include <algorithm>
#include <vector>

#include "base/text.hpp"

namespace fitgauge::interpreter {
namespace {

constexpr std::string_view kDrive = "TNC:";
constexpr std::size_t kLongestPath = 255;

Error path_error(std::string_view text, std::string_view what) {
  constexpr std::size_t kShown = 80;
  std::string shown(first_characters(text, kShown));
  if (text.size() > kShown) shown += "...";
  return {ErrorCode::FilePathInvalid, "path '" + shown + "' " + std::string(what)};
}

bool is_separator(char c) { return c == '\\' || c == '/'; }

/// Whether a path ends in `\`, `.` or `..`, which are directories.
bool names_directory(std::string_view text) {
  const auto last = std::find_if(text.rbegin(), text.rend(), is_separator);
  const std::string_view name = trim(text.substr(static_cast<std::size_t>(text.rend() - last)));
  return name.empty() || name == "." || name == "..";
}

/// Adds the components of `text`. @returns false when `..` would leave the drive.
bool append_components(std::string_view text, std::vector<std::string_view>& components) {
  while (!text.empty()) {
    const auto end = static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_separator) -
                                              text.begin());
    const std::string_view component = trim(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    if (component.empty() || component == ".") continue;
    if (component != "..") {
      components.push_back(component);
    } else if (components.empty()) {
      return false;
    } else {
      components.pop_back();
    }
  }
  return true;
}

/// @param start the directory that a relative text starts from, without its drive.
Result<std::string> normalise(std::string_view text, std::string_view start) {
  const std::string_view written = text;
  text = trim(text);
  if (std::any_of(text.begin(), text.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; })) {
    return path_error("", "holds a control character");
  }
  if (text.size() >= kDrive.size() && ascii_iequals(text.substr(0, kDrive.size()), kDrive)) {
    text.remove_prefix(kDrive.size());
    start = {};
  } else if (!text.empty() && is_separator(text.front())) {
    start = {};
  }
  if (text.find(':') != std::string_view::npos) {
    return path_error(written, "is not on the drive TNC:");
  }
  if (names_directory(text)) return path_error(written, "names no file");
  std::vector<std::string_view> components;
  if (!append_components(start, components) || !append_components(text, components)) {
    return path_error(written, "leaves TNC:\\; only files below it can be used");
  }
  std::string path(kDrive);
  for (const std::string_view component : components) {
    path += '\\';
    path += component;
  }
  if (path.size() > kLongestPath) {
    return path_error(written, "has more than " + std::to_string(kLongestPath) + " characters");
  }
  return path;
}

}  // namespace

Result<ControlPath> ControlPath::parse(std::string_view text) {
  const std::string_view trimmed = trim(text);
  if (!ascii_iequals(trimmed.substr(0, kDrive.size()), kDrive)) {
    return path_error(text, "does not begin with TNC:\\");
  }
  auto path = normalise(text, {});
  if (path.has_error()) return path.error();
  return ControlPath(std::move(*path));
}

Result<ControlPath> ControlPath::resolve(std::string_view text, const ControlPath& program) {
  auto path = normalise(text, program.directory().substr(kDrive.size()));
  if (path.has_error()) return path.error();
  return ControlPath(std::move(*path));
}

std::string ControlPath::key() const { return ascii_lower(text_); }

std::string_view ControlPath::directory() const {
  return std::string_view(text_).substr(0, text_.rfind('\\') + 1);
}

std::string_view ControlPath::file_name() const {
  return std::string_view(text_).substr(text_.rfind('\\') + 1);
}

ControlPath ControlPath::with_default_extension(std::string_view extension) const {
  if (file_name().find('.') != std::string_view::npos) return *this;
  return ControlPath(text_ + std::string(extension));
}

ControlPath ControlPath::beside(std::string_view name) const {
  return ControlPath(std::string(directory()) + std::string(name));
}

}  // namespace fitgauge::interpreter

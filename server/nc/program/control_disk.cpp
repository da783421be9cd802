#include "nc/program/control_disk.hpp"

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
    return Error{ErrorCode::FilePathInvalid, "a path has no control characters"};
  }
  if (text.size() >= kDrive.size() && ascii_iequals(text.substr(0, kDrive.size()), kDrive)) {
    text.remove_prefix(kDrive.size());
    start = {};
  } else if (!text.empty() && is_separator(text.front())) {
    start = {};
  }
  if (text.find(':') != std::string_view::npos)
    return path_error(written, "is not on the drive TNC:");
  if (names_directory(text)) return path_error(written, "names no file");
  std::vector<std::string_view> components;
  if (!append_components(start, components) || !append_components(text, components))
    return path_error(written, "leaves TNC:\\; only files below it can be used");
  std::string path(kDrive);
  for (const std::string_view component : components) {
    path += '\\';
    path += component;
  }
  if (path.size() > kLongestPath)
    return path_error(written, "has more than " + std::to_string(kLongestPath) + " characters");
  return path;
}

}  // namespace

Result<ControlPath> ControlPath::parse(std::string_view text) {
  const std::string_view trimmed = trim(text);
  if (!ascii_iequals(trimmed.substr(0, kDrive.size()), kDrive))
    return path_error(text, "does not begin with TNC:\\");
  auto path = TRY(normalise(text, {}));
  return ControlPath(std::move(path));
}

Result<ControlPath> ControlPath::resolve(std::string_view text, const ControlPath& program) {
  auto path = TRY(normalise(text, program.directory().substr(kDrive.size())));
  return ControlPath(std::move(path));
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

std::string_view word(FileSource source) { return word_of(source, {"stored", "live", "run"}); }

void MemoryDisk::write(const ControlPath& path, std::string bytes) {
  std::string revision = std::to_string(std::hash<std::string>{}(bytes));
  files_.insert_or_assign(path.key(),
                          ControlFile{path, std::make_shared<const std::string>(std::move(bytes)),
                                      std::move(revision), FileSource::Stored});
}

void MemoryDisk::write(std::string_view path, std::string bytes) {
  write(ControlPath::parse(path).value(), std::move(bytes));
}

std::optional<ControlFile> MemoryDisk::find(const ControlPath& path) const {
  const auto it = files_.find(path.key());
  return it == files_.end() ? std::nullopt : std::optional(it->second);
}

std::optional<std::string> MemoryDisk::revision(const ControlPath& path) const {
  const auto file = find(path);
  return file ? std::optional(file->revision) : std::nullopt;
}

bool MemoryDisk::has_directory(std::string_view directory) const {
  const std::string prefix = ascii_lower(directory);
  const auto it = files_.lower_bound(prefix);
  return it != files_.end() && it->first.starts_with(prefix);
}

ProjectingDisk::ProjectingDisk(const ControlDisk& inner, std::vector<Projection> projections)
    : inner_(inner), projections_(std::move(projections)) {}

const ProjectingDisk::Projection* ProjectingDisk::projection(const ControlPath& path) const {
  const auto found = std::find_if(projections_.begin(), projections_.end(), [&](const auto& p) {
    return ascii_iequals(path.file_name(), p.file_name);
  });
  return found == projections_.end() ? nullptr : &*found;
}

std::optional<ControlFile> ProjectingDisk::find(const ControlPath& path) const {
  if (auto file = inner_.find(path)) return file;
  const Projection* live = projection(path);
  if (live == nullptr) return std::nullopt;
  return ControlFile{path, live->bytes, live->revision, FileSource::Live, live->table};
}

std::optional<std::string> ProjectingDisk::revision(const ControlPath& path) const {
  if (auto stored = inner_.revision(path)) return stored;
  const Projection* live = projection(path);
  return live == nullptr ? std::nullopt : std::optional(live->revision);
}

bool ProjectingDisk::has_directory(std::string_view directory) const {
  return inner_.has_directory(directory);
}

}  // namespace fitgauge::interpreter

#include "nc/program/control_disk.hpp"

#include <algorithm>
#include <functional>

#include "base/text.hpp"

namespace fitgauge::interpreter {

std::string_view word(FileSource source) {
  switch (source) {
    case FileSource::Stored: return "stored";
    case FileSource::Live: return "live";
    case FileSource::Run: return "run";
  }
  return {};
}

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

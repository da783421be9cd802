#include "program/control_disk.hpp"

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

bool MemoryDisk::has_directory(std::string_view directory) const {
  const std::string prefix = ascii_lower(directory);
  const auto it = files_.lower_bound(prefix);
  return it != files_.end() && it->first.starts_with(prefix);
}

ProjectingDisk::ProjectingDisk(const ControlDisk& inner, std::vector<Projection> projections)
    : inner_(inner), projections_(std::move(projections)) {}

std::optional<ControlFile> ProjectingDisk::find(const ControlPath& path) const {
  if (auto file = inner_.find(path)) return file;
  for (const Projection& projection : projections_) {
    if (ascii_iequals(path.file_name(), projection.file_name)) {
      return ControlFile{path, projection.bytes, projection.revision, FileSource::Live,
                         projection.table};
    }
  }
  return std::nullopt;
}

bool ProjectingDisk::has_directory(std::string_view directory) const {
  return inner_.has_directory(directory);
}

}  // namespace fitgauge::interpreter

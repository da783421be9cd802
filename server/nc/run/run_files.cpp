#include "nc/run/run_files.hpp"

#include "base/text.hpp"

namespace fitgauge::interpreter {

std::optional<ControlFile> RunFiles::find(const ControlPath& path) const {
  const auto it = written_.find(path.key());
  if (it == written_.end()) return disk_.find(path);
  const Written& file = it->second;
  return ControlFile{file.path, file.bytes, file.revision_text(), FileSource::Run};
}

std::optional<std::string> RunFiles::revision(const ControlPath& path) const {
  const auto it = written_.find(path.key());
  return it == written_.end() ? disk_.revision(path) : it->second.revision_text();
}

bool RunFiles::has_directory(std::string_view directory) const {
  const std::string prefix = ascii_lower(directory);
  const auto it = written_.lower_bound(prefix);
  return (it != written_.end() && it->first.starts_with(prefix)) || disk_.has_directory(directory);
}

NcResult<void> RunFiles::reserve(const ControlPath& path) {
  const std::string key = path.key();
  if (reserved_.contains(key)) return {};
  if (reserved_.size() >= most_files_) {
    return limit_error("the run has written more than {} files", most_files_);
  }
  reserved_.insert(key);
  return {};
}

NcResult<void> RunFiles::write(const ControlPath& path, std::string bytes) {
  TRY(budget_.charge(bytes.size()));
  TRY(reserve(path));
  Written& file = written_.try_emplace(path.key(), Written{path, {}}).first->second;
  file.bytes = std::make_shared<std::string>(std::move(bytes));
  ++file.revision;
  return {};
}

NcResult<void> RunFiles::append(const ControlPath& path, std::string_view bytes) {
  const auto known = written_.find(path.key());
  if (known == written_.end()) {
    const auto stored = disk_.find(path);
    std::string all = stored ? *stored->bytes : std::string();
    return write(path, std::move(all += bytes));
  }
  TRY(budget_.charge(bytes.size()));
  Written& file = known->second;
  if (file.bytes.use_count() > 1) file.bytes = std::make_shared<std::string>(*file.bytes);
  *file.bytes += bytes;
  ++file.revision;
  return {};
}

std::vector<WrittenFile> RunFiles::copies() const {
  std::vector<WrittenFile> files;
  for (const auto& [key, file] : written_) files.push_back({file.path, *file.bytes});
  return files;
}

std::vector<WrittenFile> RunFiles::take() {
  std::vector<WrittenFile> files;
  for (auto& [key, file] : written_) files.push_back({file.path, std::move(*file.bytes)});
  written_.clear();
  return files;
}

}  // namespace fitgauge::interpreter

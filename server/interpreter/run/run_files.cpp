#include "run/run_files.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace fitgauge::interpreter {

std::optional<ControlFile> RunFiles::find(const ControlPath& path) const {
  const auto it = written_.find(path.key());
  if (it == written_.end()) return disk_.find(path);
  const Written& file = it->second;
  return ControlFile{file.path, std::make_shared<const std::string>(file.bytes),
                     fmt::format("run-{}", file.revision), FileSource::Run};
}

bool RunFiles::has_directory(std::string_view directory) const {
  const std::string prefix = ascii_lower(directory);
  const auto it = written_.lower_bound(prefix);
  return (it != written_.end() && it->first.starts_with(prefix)) || disk_.has_directory(directory);
}

NcResult<RunFiles::Written*> RunFiles::entry(const ControlPath& path) {
  auto it = written_.find(path.key());
  if (it == written_.end()) {
    if (written_.size() >= most_files_) {
      return limit_error(fmt::format("the run has written more than {} files", most_files_));
    }
    it = written_.emplace(path.key(), Written{path, {}}).first;
  }
  ++it->second.revision;
  return &it->second;
}

NcResult<void> RunFiles::write(const ControlPath& path, std::string bytes) {
  if (auto charged = budget_.charge(bytes.size()); !charged) return charged;
  auto file = entry(path);
  if (!file) return file.error();
  (*file)->bytes = std::move(bytes);
  return {};
}

NcResult<void> RunFiles::append(const ControlPath& path, std::string_view bytes) {
  if (!written_.contains(path.key())) {
    const auto stored = disk_.find(path);
    return write(path, (stored ? *stored->bytes : std::string()) + std::string(bytes));
  }
  if (auto charged = budget_.charge(bytes.size()); !charged) return charged;
  auto file = entry(path);
  if (!file) return file.error();
  (*file)->bytes += bytes;
  return {};
}

std::vector<WrittenFile> RunFiles::take() {
  std::vector<WrittenFile> files;
  for (auto& [key, file] : written_) files.push_back({file.path, std::move(file.bytes)});
  written_.clear();
  return files;
}

}  // namespace fitgauge::interpreter

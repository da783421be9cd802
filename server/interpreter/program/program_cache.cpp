#include "program/program_cache.hpp"

namespace fitgauge::interpreter {

std::shared_ptr<const LinkedFile> ProgramCache::get(const ControlFile& file) {
  const std::string key = file.path.key() + '|' + file.revision;
  // What a run has written has no revision that other runs share.
  const bool cached = file.source != FileSource::Run;
  if (cached) {
    const std::lock_guard lock(mutex_);
    if (const auto it = index_.find(key); it != index_.end()) {
      entries_.splice(entries_.begin(), entries_, it->second);
      return it->second->file;
    }
  }
  auto linked = std::make_shared<const LinkedFile>(
      link(klartext::parse_program(*file.bytes, file.path.text()), file.path));
  if (!cached) return linked;

  const std::lock_guard lock(mutex_);
  if (const auto it = index_.find(key); it != index_.end()) return it->second->file;
  entries_.push_front({key, linked});
  index_[key] = entries_.begin();
  bytes_ += linked->memory_bytes;
  while (bytes_ > capacity_ && entries_.size() > 1) {
    bytes_ -= entries_.back().file->memory_bytes;
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
  return linked;
}

}  // namespace fitgauge::interpreter

#include "nc/program/program_cache.hpp"

#include "nc/iso/parser.hpp"

namespace fitgauge::interpreter {

namespace {

std::string key_of(const ControlPath& path, std::string_view revision) {
  return fmt::format("{}|{}", path.key(), revision);
}

}  // namespace

std::shared_ptr<const LinkedFile> ProgramCache::at_hand(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto it = index_.find(key);
  if (it == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, it->second);
  return it->second->file;
}

std::shared_ptr<const LinkedFile> ProgramCache::get(const ControlDisk& disk,
                                                    const ControlPath& path) {
  const auto revision = disk.revision(path);
  if (!revision) return nullptr;
  if (auto linked = at_hand(key_of(path, *revision))) return linked;
  auto file = disk.find(path);
  return file ? get(*std::move(file)) : nullptr;
}

std::shared_ptr<const LinkedFile> ProgramCache::get(ControlFile file) {
  const std::string key = key_of(file.path, file.revision);
  // Files that a run wrote have no revision that other runs share.
  const bool cached = file.source != FileSource::Run;
  if (cached) {
    if (auto linked = at_hand(key)) return linked;
  }
  std::string source = *file.bytes;
  file.bytes.reset();  // a large program is not held twice
  auto linked = std::make_shared<const LinkedFile>(
      link(iso::parse_program(std::move(source), file.path.text()), file.path));
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

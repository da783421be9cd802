#pragma once

#include <list>
#include <unordered_map>

#include "nc/program/control_disk.hpp"

namespace fitgauge::interpreter {

struct LinkedFile;

/// Programs parsed and linked once for each revision of their file, the least recently used dropped
/// beyond a size. Thread-safe; two threads that miss at once both link, and one result is stored.
class ProgramCache {
 public:
  explicit ProgramCache(std::size_t bytes = std::size_t{32} << 20) : capacity_(bytes) {}

  /// Returns the linked file, even with errors; null if the path does not exist. The disk reads its
  /// bytes only if they are not cached.
  std::shared_ptr<const LinkedFile> get(const ControlDisk& disk, const ControlPath& path);
  /// Returns the linked form of a file that was read. Never null.
  std::shared_ptr<const LinkedFile> get(ControlFile file);

 private:
  std::shared_ptr<const LinkedFile> at_hand(const std::string& key);

  struct Entry {
    std::string key;
    std::shared_ptr<const LinkedFile> file;
  };

  const std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;  // the most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> index_;
  std::size_t bytes_ = 0;
};

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/program/control_disk.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

/// The uploaded files as a control's disk. Thread-safe. Every call reads the database and waits for
/// it, so it is for worker threads alone. Throws when the storage fails.
class StoredDisk final : public interpreter::ControlDisk {
 public:
  /// @param database outlives the disk.
  explicit StoredDisk(store::Database& database) : database_(database) {}

  std::optional<interpreter::ControlFile> find(const interpreter::ControlPath& path) const override;
  std::optional<std::string> revision(const interpreter::ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

 private:
  store::Database& database_;
};

/// A disk on which one file has the text that is being written, stored or not. Thread-safe as the
/// disk below.
class DraftDisk final : public interpreter::ControlDisk {
 public:
  /// @param inner outlives the disk.
  DraftDisk(const interpreter::ControlDisk& inner, const interpreter::ControlPath& path,
            std::string text);

  std::optional<interpreter::ControlFile> find(const interpreter::ControlPath& path) const override;
  std::optional<std::string> revision(const interpreter::ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

 private:
  const interpreter::ControlDisk& inner_;
  const interpreter::ControlFile draft_;
};

}  // namespace fitgauge::app

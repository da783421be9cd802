#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <optional>
#include <string>

#include "base/descriptor.hpp"
#include "base/digest.hpp"
#include "base/folder.hpp"
#include "base/read.hpp"
#include "base/result.hpp"

namespace fitgauge::connections {

/// As a file looks from outside.
struct Look {
  std::int64_t size = 0;
  std::int64_t changed_ns = 0;
  std::uint64_t inode = 0;

  friend bool operator==(const Look&, const Look&) = default;
};

Look look_of(const struct stat& status);

/// A file of a folder, which is read from its begin as often as it must be, a piece at a time.
/// What was read counts when it is_unchanged() afterwards.
class RestingFile {
 public:
  /// @returns nothing when it is gone, or another kind of entry. @errors StorageUnavailable: it
  /// cannot be read.
  static Result<std::optional<RestingFile>> open(const Folder& folder, const std::string& name,
                                                 const Look& look);

  /// The bytes from the begin on. @errors StorageUnavailable. The file outlives it.
  Read from_begin() const;
  /// @errors StorageUnavailable
  Result<void> add_to(Sha256& digest) const;
  /// Whether it looks as it did when it was opened.
  bool is_unchanged() const;

 private:
  RestingFile(std::string name, Descriptor file, const Look& look)
      : name_(std::move(name)), file_(std::move(file)), look_(look) {}

  std::string name_;
  Descriptor file_;
  Look look_;
};

}  // namespace fitgauge::connections

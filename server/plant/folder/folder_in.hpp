#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/digest.hpp"
#include "base/folder.hpp"
#include "formats/dfq/measurement_csv.hpp"
#include "plant/plant.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::connections {

/// A folder that others put files of measurements into.
struct FolderInOptions {
  std::string name{};  ///< of the connection
  std::filesystem::path folder{};
  std::vector<std::string> names{"*.csv", "*.txt", "*.ndjson", "*.jsonl",
                                 "*.dfq", "*.dfd", "*.dfx",    "*.qif"};  ///< in either case
  aqdef::MeasurementOptions csv{};    ///< of files that are not NDJSON by their name
  std::chrono::seconds interval{10};  ///< between two scans; the kernel reports changes at once
  std::chrono::seconds rest{2};       ///< size and time must be unchanged for this time
  std::size_t most_file_bytes = std::size_t{32} << 20;
  std::size_t most_entries = 100'000;  ///< of one look
};

/// What a folder shows of a file: a change of the file changes it.
struct Look {
  std::int64_t size = 0;
  std::int64_t changed_ns = 0;
  std::uint64_t inode = 0;

  friend bool operator==(const Look&, const Look&) = default;
  static Look of(const struct stat& status) {
    return {.size = status.st_size,
            .changed_ns = std::int64_t{status.st_mtim.tv_sec} * kNanosecondsPerSecond +
                          status.st_mtim.tv_nsec,
            .inode = status.st_ino};
  }
};

/// A file of a folder. It is read piece by piece, as often as necessary from its beginning. The
/// content counts only if it is_unchanged() afterwards.
class RestingFile {
 public:
  /// @param file is open for reading. @param look how it looked before it was opened
  RestingFile(std::string name, Descriptor file, const Look& look)
      : name_(std::move(name)), file_(std::move(file)), look_(look) {}

  /// Reads the bytes from the beginning. @errors StorageUnavailable. The file outlives it.
  Read from_begin() const {
    return [this, at = off_t{0}](std::span<char> into) mutable -> Result<std::size_t> {
      for (;;) {
        const ssize_t count = pread(file_.get(), into.data(), into.size(), at);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) {
          return Error{ErrorCode::StorageUnavailable,
                       fmt::format("{} cannot be read: {}", name_, std::strerror(errno))};
        }
        at += count;
        return static_cast<std::size_t>(count);
      }
    };
  }
  /// @errors StorageUnavailable
  Result<void> add_to(Sha256& digest) const {
    const Read read = from_begin();
    std::string piece(std::size_t{1} << 16, '\0');
    for (;;) {
      const auto count = TRY(read(piece));
      if (count == 0) return {};
      digest.update(std::string_view(piece).substr(0, count));
    }
  }
  /// Returns whether the file looks as it did when it was opened.
  bool is_unchanged() const {
    struct stat status {};
    return fstat(file_.get(), &status) == 0 && Look::of(status) == look_;
  }

 private:
  std::string name_;
  Descriptor file_;
  Look look_;
};

/// Stores the measurements of a file, all rows or none. The same bytes are stored once for a
/// connection: the transaction of the rows stores their digest for ever. Blocks.
/// @param description of a DFX: its DFD; else null.
/// @param stop ends it between two rows: nothing of the file is stored.
/// @returns how many it has stored, 0 if the same bytes were stored before; nothing if the file has
///   changed.
/// @errors of status 5xx (ShuttingDown after a stop) and IdempotencyInProgress: try again; any
///   other: the file is wrong.
Result<std::optional<std::size_t>> take_file(const FolderInOptions& options, const Plant& plant,
                                             std::string_view file_name, const RestingFile& file,
                                             const RestingFile* description,
                                             const std::stop_token& stop);

/// Returns the errors of a file as a text for the person who wrote it: lines and remedies.
std::string told(std::string_view file_name, const Error& error);

}  // namespace fitgauge::connections

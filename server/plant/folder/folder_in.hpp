#pragma once

#include <sys/stat.h>

#include <filesystem>

#include "base/digest.hpp"
#include "base/folder.hpp"
#include "base/result.hpp"
#include "formats/dfq/description.hpp"
#include "formats/sheet/shop_csv.hpp"
#include "formats/sheet/text_encoding.hpp"
#include "plant/plant.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::connections {

/// A folder that others put files of measurements into.
struct FolderInOptions {
  std::string name{};  ///< of the connection
  std::filesystem::path folder{};
  std::vector<std::string> names{"*.csv", "*.txt", "*.ndjson", "*.jsonl",
                                 "*.dfq", "*.dfd", "*.dfx",    "*.qif"};  ///< in either case
  sheet::ShopCsvOptions csv{};                     ///< of files that are not NDJSON by their name
  std::optional<aqdef::LengthUnit> length_unit{};  ///< of a DFQ or QIF without a unit
  std::chrono::seconds interval{10};  ///< between two scans; the kernel reports changes at once
  std::chrono::seconds rest{2};       ///< size and time must be unchanged for this time
  std::size_t most_file_bytes = std::size_t{32} << 20;
  std::size_t most_entries = 100'000;  ///< of one look
};

/// Stores the files of a folder, each once, and moves them to its folder `done`, or with a text
/// that has line and remedy to `failed`. @param plant must outlive it.
std::unique_ptr<Worker> make(const FolderInOptions& options, const Plant& plant);

/// Whether the folder can be read, and files moved in it.
ConnectionTest test_of(const FolderInOptions& options, const Plant&, const std::stop_token&);

/// Outward state of a file.
struct Look {
  std::int64_t size = 0;
  std::int64_t changed_ns = 0;
  std::uint64_t inode = 0;

  friend bool operator==(const Look&, const Look&) = default;
};

Look look_of(const struct stat& status);

/// A file of a folder. It is read piece by piece, as often as necessary from its beginning. The
/// content counts only if it is_unchanged() afterwards.
class RestingFile {
 public:
  /// @returns nothing if it is gone, or not a file. @errors StorageUnavailable: it cannot be read.
  static Result<std::optional<RestingFile>> open(const Folder& folder, const std::string& name,
                                                 const Look& look);

  /// The bytes from the begin on. @errors StorageUnavailable. The file outlives it.
  Read from_begin() const;
  /// @errors StorageUnavailable
  Result<void> add_to(Sha256& digest) const;
  /// Returns whether the file looks as it did when it was opened.
  bool is_unchanged() const;

 private:
  RestingFile(std::string name, Descriptor file, const Look& look)
      : name_(std::move(name)), file_(std::move(file)), look_(look) {}

  std::string name_;
  Descriptor file_;
  Look look_;
};

/// Whether a file has values and no description: a DFX.
bool is_values_alone(std::string_view file_name);
/// Whether it is the description of such a file: a DFD.
bool is_description(std::string_view file_name);

/// Measurements of a file as for /v1/measurements, with room for http::Request::kBodyPadding.
struct FileRows {
  static constexpr std::size_t kMostBytes = std::size_t{48} << 20;

  std::string media_type{};
  std::string text{};
  std::vector<std::uint32_t> lines{};  ///< of the file, for each row; empty: they are the same
};

/// Reads a table, NDJSON, DFQ or QIF by its name, piece by piece, and keeps only its rows.
/// @param description of a DFX: its DFD; else null.
/// @errors BodyTooLarge; those of ShopRows, NdjsonRows, MeasurementCsv and QifRows
Result<FileRows> read_file_rows(const FolderInOptions& options,
                                const iso286::ToleranceTables& tables, std::string_view file_name,
                                const RestingFile& file, const RestingFile* description);

/// An error of the rows with the lines of the file.
Error at_lines_of(const FileRows& rows, Error error);

/// The result of a file.
struct TakenFile {
  bool was_taken_before = false;
  std::size_t measurements = 0;
};

/// Stores the measurements of a file, all rows or none. The same bytes are stored once for a
/// connection: the transaction of the rows stores their digest for ever. Blocks.
/// @param description of a DFX: its DFD; else null.
/// @returns nothing if the file has changed.
/// @errors StorageBusy, StorageUnavailable, ShuttingDown: try again; any other: the file is wrong.
Result<std::optional<TakenFile>> take_file(const FolderInOptions& options, const Plant& plant,
                                           std::string_view file_name, const RestingFile& file,
                                           const RestingFile* description);

/// The errors of a file for its writer: lines and remedies.
std::string told(std::string_view file_name, const Error& error);

/// Whether an error is one of the storage, not of the file.
bool is_of_storage(const Error& error);

}  // namespace fitgauge::connections

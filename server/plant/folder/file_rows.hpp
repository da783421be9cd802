#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plant/folder/folder_in.hpp"
#include "plant/folder/resting_file.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::connections {

/// Whether a file has values and no description: a DFX.
bool is_values_alone(std::string_view file_name);
/// Whether it is the description of such a file: a DFD.
bool is_description(std::string_view file_name);

/// The measurements of a file as /v1/measurements takes them. What is behind the text up to its
/// capacity is at least http::Request::kBodyPadding bytes.
struct FileRows {
  static constexpr std::size_t kMostBytes = std::size_t{48} << 20;

  std::string media_type{};
  std::string text{};
  std::vector<std::uint32_t> lines{};  ///< of the file, for each row; empty: they are the same
};

/// Reads a table, NDJSON, DFQ or QIF by its name, a piece at a time: what is kept of it are its
/// rows.
/// @param description of a DFX: its DFD; else null.
/// @errors BodyTooLarge; those of sheet::ShopRows, sheet::NdjsonRows, aqdef::MeasurementCsv and
///   qif::QifRows
Result<FileRows> read_file_rows(const FolderInOptions& options,
                                const iso286::ToleranceTables& tables, std::string_view file_name,
                                const RestingFile& file, const RestingFile* description);

/// An error of the rows with the lines of the file.
Error at_lines_of(const FileRows& rows, Error error);

}  // namespace fitgauge::connections

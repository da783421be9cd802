#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/measurements/measurement.hpp"
#include "aqdef/dfq_writer.hpp"
#include "base/result.hpp"
#include "connections/folder_in.hpp"
#include "iso286/tolerance_tables.hpp"

namespace fitgauge::connections {

/// Whether a file is a DFQ, or a DFX, by its name.
bool is_dfq(std::string_view file_name);
/// Whether it has values and no description: a DFX.
bool is_values_alone(std::string_view file_name);
/// Whether it is the description of such a file: a DFD.
bool is_description(std::string_view file_name);

/// A DFQ or QIF as CSV that /v1/measurements takes.
struct DfqText {
  std::string csv{};
  std::vector<std::uint32_t> lines{};  ///< of the file, for each row
};

/// @param description of a DFX: its DFD; empty for a DFQ. @errors those of aqdef::MeasurementCsv
Result<DfqText> read_dfq(const FolderInOptions& options, const iso286::ToleranceTables& tables,
                         std::string_view description, std::string_view values);

/// The same of a QIF. @errors those of qif::read_qif
Result<DfqText> read_qif_file(const FolderInOptions& options, const iso286::ToleranceTables& tables,
                              std::string_view text);

/// An error of the rows with the lines of the file instead of those of the CSV.
Error at_lines_of(const DfqText& text, Error error);

}  // namespace fitgauge::connections

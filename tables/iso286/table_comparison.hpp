#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "tables/iso286/table_data.hpp"

namespace fitgauge::iso286 {

/// A finding in one cell, naming table, range and column.
Error finding(TableId table, const NominalSizeRange& range, std::string_view column,
              std::string_view what);

/// The cells that the standard's tables have and `data` lacks, those it has besides, and those it
/// has twice. Without findings the ranges are those of the standard, so they are contiguous.
std::vector<Error> compare_structure(const TableData& data);

}  // namespace fitgauge::iso286

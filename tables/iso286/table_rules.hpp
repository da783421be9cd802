#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/result.hpp"
#include "tables/iso286/table_data.hpp"

namespace fitgauge::iso286 {

/// Every finding in tables that are not consistent in themselves: contiguous ranges, no missing or
/// additional column, grades strictly increase, no tolerance decreases with size, the deltas are
/// differences of tolerances, holes mirror shafts, upper - lower = IT, JS is symmetric, and the
/// custom columns as check_custom_column.
/// @returns TablesInconsistent each, naming table, range and column; empty when all hold.
std::vector<Error> table_rules(const TableData& data);

/// Every cell of the standard's tables that differs from the compiled-in ones: a changed cell can
/// satisfy every rule. Custom columns are not compared.
/// @returns TablesInconsistent each, naming table, range, column, found and expected.
std::vector<Error> compare_with_compiled_in(const TableData& data);

/// What a shop's own column must be: a name of the grammar whose case is the feature's and that is
/// not NR or BEREICH, at least one row, contiguous ascending ranges within 0 to 3150 mm, and
/// upper >= lower.
/// @errors TableRowsInvalid; `details` has one entry a finding, `where` its JSON pointer.
Result<void> check_custom_column(const CustomColumn& column);

}  // namespace fitgauge::iso286

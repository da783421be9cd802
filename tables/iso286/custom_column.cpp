#include <fmt/format.h>

#include "tables/iso286/table_rules.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {
namespace {

void check_row(const CustomColumn& column, std::size_t i, std::vector<Error>& findings) {
  const CustomRow& row = column.rows[i];
  const auto add = [&](std::string_view field, std::string message) {
    findings.push_back(
        {ErrorCode::TableRowsInvalid, std::move(message), fmt::format("/rows/{}/{}", i, field)});
  };
  if (row.range.over < Length()) add("over_mm", "a range starts at 0 mm or above");
  if (row.range.up_to > kLargestNominalSize) add("up_to_mm", "a range ends at 3150 mm or below");
  if (row.range.up_to <= row.range.over) add("up_to_mm", "a range ends above its start");
  if (row.deviations.upper < row.deviations.lower) {
    add("upper_um", "the upper deviation is less than the lower one");
  }
  if (i > 0 && row.range.over != column.rows[i - 1].range.up_to) {
    add("over_mm", fmt::format("the range does not start where the one before ends, at {} mm",
                               format_mm(column.rows[i - 1].range.up_to)));
  }
}

}  // namespace

Result<void> check_custom_column(const CustomColumn& column) {
  std::vector<Error> findings;
  if (!is_class_name(column.name)) {
    findings.push_back({ErrorCode::TableRowsInvalid,
                        "a column's name is a letter and up to 15 letters, digits or underscores",
                        "/name"});
  } else if (feature_of_name(column.name) != column.feature) {
    findings.push_back({ErrorCode::TableRowsInvalid,
                        "names of hole columns start with an upper-case letter, those of shaft "
                        "columns with a lower-case one",
                        "/name"});
  } else if (column.name == "NR" || column.name == "BEREICH") {
    findings.push_back({ErrorCode::TableRowsInvalid,
                        "NR and BEREICH are columns of the control's table already", "/name"});
  }
  if (column.rows.empty()) {
    findings.push_back({ErrorCode::TableRowsInvalid, "a column needs at least one row", "/rows"});
  }
  for (std::size_t i = 0; i < column.rows.size(); ++i) check_row(column, i, findings);
  if (findings.empty()) return {};
  return Error{ErrorCode::TableRowsInvalid,
               fmt::format("column '{}' of the {} table is not valid: {}", column.name,
                           word(column.feature), findings.front().message),
               findings.front().where, findings};
}

}  // namespace fitgauge::iso286

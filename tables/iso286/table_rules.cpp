#include "tables/iso286/tolerance_tables.hpp"

#include "tables/compiled_in.hpp"
#include "tables/iso286/derivation.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {
namespace {

constexpr std::string_view kSymmetric = "+-IT/2";

/// Appends the cells of a file, column by column, as stores give them. The files are our own:
/// unreadable data is a bug, so value() may throw.
void append_cells(TableData& data, TableId table) {
  constexpr std::size_t kFirstColumn = 2;  // after over_mm, to_mm
  const auto begun = static_cast<std::ptrdiff_t>(data.cells.size());
  std::string_view csv = compiled_in_csv(name(table));
  const auto header = split(take_field(csv, '\n'), ',');
  while (!csv.empty()) {
    const auto fields = split(take_field(csv, '\n'), ',');
    if (fields.size() != header.size()) {
      throw std::logic_error(std::string(name(table)) + ".csv: a row has too few or many fields");
    }
    const NominalSizeRange range{parse_length_mm(fields[0]).value(),
                                 parse_length_mm(fields[1]).value()};
    for (std::size_t i = kFirstColumn; i < fields.size(); ++i) {
      if (fields[i] == kSymmetric) continue;
      std::optional<Length> value;
      if (!fields[i].empty()) value = parse_length_um(fields[i]).value();
      data.cells.push_back({table, range, std::string(header[i]), value});
    }
  }
  std::ranges::stable_sort(data.cells.begin() + begun, data.cells.end(), {}, &TableCell::column);
}

using CellKey = std::tuple<TableId, NominalSizeRange, std::string_view>;
using CellsByKey = std::map<CellKey, const TableCell*>;

CellKey key_of(const TableCell& cell) { return {cell.table, cell.range, cell.column}; }

const CellsByKey& compiled_in_by_key() {
  static const CellsByKey kCells = [] {
    CellsByKey cells;
    for (const TableCell& cell : compiled_in_tables().cells) cells.emplace(key_of(cell), &cell);
    return cells;
  }();
  return kCells;
}

std::string text_of(std::optional<Length> value) {
  return value ? format_um(*value) + " µm" : "nothing";
}

/// A finding in one cell, naming table, range and column.
Error finding(TableId table, const NominalSizeRange& range, std::string_view column,
              std::string_view what) {
  return {ErrorCode::TablesInconsistent,
          fmt::format("{}, {}, {}: {}", name(table), format_range(range), column, what),
          fmt::format("{}/{}-{}/{}", name(table), format_mm(range.over), format_mm(range.up_to),
                      column)};
}

/// Finds missing, additional and repeated cells of the standard's tables in `data`. Without
/// findings the ranges are those of the standard, so they are contiguous.
std::vector<Error> compare_structure(const TableData& data) {
  std::vector<Error> findings;
  CellsByKey found;
  for (const TableCell& cell : data.cells) {
    const bool first = found.emplace(key_of(cell), &cell).second;
    const bool expected = compiled_in_by_key().contains(key_of(cell));
    if (first && expected) continue;
    findings.push_back(finding(cell.table, cell.range, cell.column,
                               first ? "the standard has no such cell" : "the cell occurs twice"));
  }
  for (const auto& [key, cell] : compiled_in_by_key()) {
    if (found.contains(key)) continue;
    findings.push_back(finding(cell->table, cell->range, cell->column, "the cell is missing"));
  }
  return findings;
}

using Findings = std::vector<Error>;
using Column = IndexedTable::Column;
using Grade = StandardToleranceGrade;

constexpr TableId kGrades = TableId::ItGrades;
constexpr TableId kHoles = TableId::HoleFundamentalDeviations;

std::string grade_column(Grade grade) { return "IT" + std::string(text(grade)); }

constexpr Grade next_coarser(Grade grade) {
  return static_cast<Grade>(static_cast<std::uint8_t>(grade) + 1);
}

/// In each step every grade is coarser than the previous one; only the finest may be missing.
void check_grades_increase(const IndexedTable& table, Findings& findings) {
  for (Grade before = Grade::IT01; before < Grade::IT18; before = next_coarser(before)) {
    const Grade grade = next_coarser(before);
    const Column finer = table.column(grade_column(before));
    const Column coarser = table.column(grade_column(grade));
    for (std::size_t i = 0; i < table.ranges().size(); ++i) {
      if (!finer[i] || (coarser[i] && *coarser[i] > *finer[i])) continue;
      findings.push_back(finding(kGrades, table.ranges()[i], grade_column(grade),
                                 "is not greater than " + grade_column(before)));
    }
  }
}

void check_tolerances_grow_with_size(const IndexedTable& table, Findings& findings) {
  for (Grade grade = Grade::IT01; grade <= Grade::IT18; grade = next_coarser(grade)) {
    const Column column = table.column(grade_column(grade));
    for (std::size_t i = 1; i < column.size(); ++i) {
      if (!column[i] || (column[i - 1] && *column[i] >= *column[i - 1])) continue;
      findings.push_back(finding(kGrades, table.ranges()[i], grade_column(grade),
                                 "is less than in the step of smaller sizes"));
    }
  }
}

/// delta_ITn = IT(n) - IT(n-1) from 3 to 500 mm, otherwise 0 (ISO 286-1, 4.3.2.5).
void check_deltas(const StandardTables& tables, Findings& findings) {
  constexpr NominalSizeRange kWithDelta{Length::millimetres(3), Length::millimetres(500)};
  const auto& ranges = tables.holes.ranges();
  for (Grade before = Grade::IT2; before < Grade::IT8; before = next_coarser(before)) {
    const Grade grade = next_coarser(before);
    const std::string name = "delta_" + grade_column(grade);
    const Column deltas = tables.holes.column(name);
    const Column coarser = tables.tolerances.column(grade_column(grade));
    const Column finer = tables.tolerances.column(grade_column(before));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const std::size_t step = tables.tolerances.index_of(ranges[i]);
      if (!coarser[step] || !finer[step]) continue;  // found above
      const Length expected =
          kWithDelta.contains(ranges[i]) ? *coarser[step] - *finer[step] : Length();
      if (deltas[i] == expected) continue;
      findings.push_back(finding(kHoles, ranges[i], name, "is not " + format_um(expected) + " µm"));
    }
  }
}

/// Columns of holes and shafts with opposite signs: A to H, P to ZC, and the bases of K, M and N.
std::vector<std::pair<std::string, std::string>> mirrored_columns() {
  std::vector<std::pair<std::string, std::string>> pairs = {{"ES_K_le_IT8_base", "ei_k_IT4_to_IT7"},
                                                            {"ES_M_le_IT8_base", "ei_m"},
                                                            {"ES_M_gt_IT8", "ei_m"},
                                                            {"ES_N_le_IT8_base", "ei_n"}};
  for (std::size_t i = 0; i < kLetterCount; ++i) {
    const auto letter = static_cast<DeviationLetter>(i);
    const std::string hole(text(letter, Feature::Hole));
    const std::string shaft(text(letter, Feature::Shaft));
    if (letter <= DeviationLetter::H) pairs.emplace_back("EI_" + hole, "es_" + shaft);
    if (letter >= DeviationLetter::P) pairs.emplace_back("ES_" + hole + "_gt_IT7", "ei_" + shaft);
  }
  return pairs;
}

void check_mirror(const StandardTables& tables, Findings& findings) {
  for (const auto& [hole, shaft] : mirrored_columns()) {
    const Column holes = tables.holes.column(hole);
    const Column shafts = tables.shafts.column(shaft);
    for (std::size_t i = 0; i < holes.size(); ++i) {
      const auto mirrored = shafts[i] ? std::optional(-*shafts[i]) : std::nullopt;
      if (holes[i] == mirrored) continue;
      findings.push_back(
          finding(kHoles, tables.holes.ranges()[i], hole, "does not mirror " + shaft));
    }
  }
}

/// For every class: upper - lower = IT; JS and js are symmetric about the nominal size.
void check_classes(const StandardTables& tables, Findings& findings) {
  const auto ranges = derivation_ranges(tables);
  for (std::uint16_t id = 0; id < kStandardClassCount; ++id) {
    const ToleranceClass c = standard_class(ClassId{id});
    const auto deviations = derive(tables, c, ranges);
    const Column tolerances = tables.tolerances.column(grade_column(c.grade));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (!deviations[i]) continue;
      const auto& [range, row, step] = ranges[i];
      const auto& [upper, lower] = *deviations[i];
      if (upper - lower != tolerances[step]) {
        findings.push_back(finding(kGrades, range, name(c), "upper - lower is not IT"));
      }
      if (c.letter == DeviationLetter::JS && upper != -lower) {
        findings.push_back(finding(kGrades, range, name(c), "is not symmetric"));
      }
    }
  }
}

void check_row(const CustomColumn& column, std::size_t i, std::vector<Error>& findings) {
  const CustomRow& row = column.rows[i];
  const auto add = [&](std::string_view field, std::string message) {
    findings.push_back(
        {ErrorCode::TableRowsInvalid, std::move(message), fmt::format("/rows/{}/{}", i, field)});
  };
  if (row.range.over < Length()) add("over_mm", "a range must start at 0 mm or above");
  if (row.range.up_to > kLargestNominalSize)
    add("up_to_mm", "a range must end at 3150 mm or below");
  if (row.range.up_to <= row.range.over)
    add("up_to_mm", "the end of a range must be above its start");
  if (row.deviations.upper < row.deviations.lower) {
    add("upper_um", "the upper deviation must not be less than the lower deviation");
  }
  if (i > 0 && row.range.over != column.rows[i - 1].range.up_to) {
    add("over_mm", fmt::format("the range must start at the end of the previous range, {} mm",
                               format_mm(column.rows[i - 1].range.up_to)));
  }
}

}  // namespace

const TableData& compiled_in_tables() {
  static const TableData kData = [] {
    TableData data;
    for (const TableId table : kTableIds) append_cells(data, table);
    return data;
  }();
  return kData;
}

bool has_compiled_in_cells(const TableData& data) {
  return data.cells == compiled_in_tables().cells;
}

std::vector<Error> compare_with_compiled_in(const TableData& data) {
  if (has_compiled_in_cells(data)) return {};
  std::vector<Error> findings = compare_structure(data);
  for (const TableCell& cell : data.cells) {
    const auto expected = compiled_in_by_key().find(key_of(cell));
    if (expected == compiled_in_by_key().end() || expected->second->value == cell.value) continue;
    findings.push_back(finding(cell.table, cell.range, cell.column,
                               fmt::format("found {}, the standard has {}", text_of(cell.value),
                                           text_of(expected->second->value))));
  }
  return findings;
}

std::vector<Error> custom_column_findings(const TableData& data) {
  std::vector<Error> findings;
  std::set<std::string_view> names;
  for (const CustomColumn& column : data.custom_columns) {
    const std::string where = std::string(word(column.feature)) + "/" + column.name;
    if (auto checked = check_custom_column(column); !checked) {
      findings.push_back({ErrorCode::TablesInconsistent, checked.error().message, where});
    }
    if (!names.insert(column.name).second) {
      findings.push_back(
          {ErrorCode::TablesInconsistent, "column '" + column.name + "' is repeated", where});
    }
  }
  return findings;
}

std::vector<Error> table_rules(const TableData& data) {
  Findings findings = compare_structure(data);
  if (findings.empty()) {  // the values of incomplete tables cannot be compared
    const StandardTables tables(data.cells);
    check_grades_increase(tables.tolerances, findings);
    check_tolerances_grow_with_size(tables.tolerances, findings);
    check_deltas(tables, findings);
    check_mirror(tables, findings);
    check_classes(tables, findings);
  }
  std::ranges::move(custom_column_findings(data), std::back_inserter(findings));
  return findings;
}

Result<void> check_custom_column(const CustomColumn& column) {
  std::vector<Error> findings;
  const auto add = [&](std::string message, std::string where) {
    findings.push_back({ErrorCode::TableRowsInvalid, std::move(message), std::move(where)});
  };
  if (!is_class_name(column.name)) {
    add("the name must be a letter and up to 15 letters, digits or underscores", "/name");
  } else if (feature_of_name(column.name) != column.feature) {
    add("the name for holes must begin with an upper-case letter, for shafts with a lower-case "
        "letter",
        "/name");
  } else if (column.name == "NR" || column.name == "BEREICH") {
    add("the name must not be NR or BEREICH: these are columns of the control's table", "/name");
  }
  if (column.rows.empty()) add("a custom tolerance class needs at least one row", "/rows");
  for (std::size_t i = 0; i < column.rows.size(); ++i) check_row(column, i, findings);
  if (findings.empty()) return {};
  return Error{ErrorCode::TableRowsInvalid,
               fmt::format("column '{}' of the {} table is not valid: {}", column.name,
                           word(column.feature), findings.front().message),
               findings.front().where, findings};
}

}  // namespace fitgauge::iso286

#include "tables/iso286/tolerance_tables.hpp"

#include <doctest/doctest.h>

#include "tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

namespace {

constexpr TableId kGrades = TableId::ItGrades;
constexpr TableId kHoles = TableId::HoleFundamentalDeviations;

TableCell& cell(TableData& data, TableId table, int up_to, std::string_view column) {
  const auto found = std::find_if(data.cells.begin(), data.cells.end(), [&](const TableCell& c) {
    return c.table == table && c.range.up_to == Length::millimetres(up_to) && c.column == column;
  });
  REQUIRE(found != data.cells.end());
  return *found;
}

TableData changed(TableId table, int up_to, std::string_view column, const char* um) {
  TableData data = compiled_in_tables();
  cell(data, table, up_to, column).value =
      *um == '\0' ? std::nullopt : std::optional(parse_length_um(um).value());
  return data;
}

bool names(const std::vector<Error>& findings, std::string_view where) {
  return std::any_of(findings.begin(), findings.end(), [&](const Error& finding) {
    return finding.code == ErrorCode::TablesInconsistent && finding.where == where;
  });
}

}  // namespace

TEST_CASE("the compiled-in tables satisfy every rule") {
  CHECK(compiled_in_tables().cells.size() == 21 * 20 + 41 * 38 + 41 * 31);
  CHECK(table_rules(compiled_in_tables()).empty());
  CHECK(compare_with_compiled_in(compiled_in_tables()).empty());
}

TEST_CASE("a changed cell breaks the rule it takes part in") {
  CHECK(names(table_rules(changed(kGrades, 30, "IT9", "84")), "it_grades/18-30/IT10"));
  CHECK(names(table_rules(changed(kGrades, 30, "IT9", "33")), "it_grades/18-30/IT9"));
  CHECK(names(table_rules(changed(kGrades, 30, "IT9", "42")), "it_grades/18-30/IT9"));
  CHECK(names(table_rules(changed(kGrades, 30, "IT9", "")), "it_grades/18-30/IT9"));
  CHECK(names(table_rules(changed(kGrades, 30, "IT7", "22")),
              "hole_fundamental_deviations/18-24/delta_IT7"));
  CHECK(names(table_rules(changed(kHoles, 24, "delta_IT7", "9")),
              "hole_fundamental_deviations/18-24/delta_IT7"));
  CHECK(names(table_rules(changed(kHoles, 3, "delta_IT7", "1")),
              "hole_fundamental_deviations/0-3/delta_IT7"));
  CHECK(names(table_rules(changed(kHoles, 24, "EI_G", "8")),
              "hole_fundamental_deviations/18-24/EI_G"));
  CHECK(names(table_rules(changed(kHoles, 24, "ES_N_le_IT8_base", "15")),
              "hole_fundamental_deviations/18-24/ES_N_le_IT8_base"));
  CHECK(names(table_rules(changed(TableId::ShaftFundamentalDeviations, 24, "ei_p", "")),
              "hole_fundamental_deviations/18-24/ES_P_gt_IT7"));
}

TEST_CASE("an odd nanometre of tolerance cannot be halved") {
  CHECK(names(table_rules(changed(kGrades, 30, "IT12", "210.001")), "it_grades/18-24/JS12"));
}

TEST_CASE("a change that satisfies every rule is found by comparing the cells") {
  const TableData data = changed(kGrades, 30, "IT9", "53");
  CHECK(table_rules(data).empty());
  const auto findings = compare_with_compiled_in(data);
  REQUIRE(findings.size() == 1);
  CHECK(findings.front().message ==
        "it_grades, over 18 up to and including 30 mm, IT9: found 53 µm, the standard has 52 µm");
  CHECK(findings.front().where == "it_grades/18-30/IT9");
}

TEST_CASE("missing, additional and repeated cells are found") {
  TableData missing = compiled_in_tables();
  std::erase(missing.cells, cell(missing, kGrades, 3, "IT01"));
  CHECK(names(table_rules(missing), "it_grades/0-3/IT01"));
  CHECK(names(compare_with_compiled_in(missing), "it_grades/0-3/IT01"));

  TableData additional = compiled_in_tables();
  cell(additional, kGrades, 3, "IT01").column = "IT19";
  CHECK(names(table_rules(additional), "it_grades/0-3/IT19"));
  CHECK(names(table_rules(additional), "it_grades/0-3/IT01"));

  TableData shifted = compiled_in_tables();
  cell(shifted, kGrades, 3, "IT01").range.up_to = Length::millimetres(4);
  CHECK(names(table_rules(shifted), "it_grades/0-4/IT01"));

  TableData repeated = compiled_in_tables();
  repeated.cells.push_back(TableCell(cell(repeated, kGrades, 3, "IT01")));
  CHECK(names(table_rules(repeated), "it_grades/0-3/IT01"));
  CHECK_FALSE(table_rules({}).empty());
}

TEST_CASE("custom columns are checked with the tables") {
  TableData data = compiled_in_tables();
  const CustomRow row{{Length(), Length::millimetres(3)}, {Length(), Length::micrometres(1)}};
  data.custom_columns = {{Feature::Hole, "H7", {row}}};
  CHECK(names(table_rules(data), "hole/H7"));
  CHECK(compare_with_compiled_in(data).empty());
  data.custom_columns[0].rows[0].deviations.upper = Length::micrometres(2);
  CHECK(table_rules(data).empty());
  data.custom_columns.push_back(data.custom_columns[0]);
  CHECK(names(table_rules(data), "hole/H7"));
}

TEST_CASE("tables that break a rule are not made") {
  const auto tables = ToleranceTables::make(changed(kGrades, 30, "IT7", "22"), {});
  CHECK(tables.error().code == ErrorCode::TablesInconsistent);
  CHECK(tables.error().details.size() >= 2);
}

TEST_CASE("a table has one name") {
  CHECK(table_from_name(name(kHoles)) == kHoles);
  CHECK_FALSE(table_from_name("holes"));
}

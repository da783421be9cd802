#include "tables/tabfile/iso286_projection.hpp"

#include <doctest/doctest.h>

#include <sstream>

#include "tables/tabfile/tab_table.hpp"
#include "unit/tables/iso286/tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::tabfile;
using namespace fitgauge::iso286;

namespace {

TabTable read_again(std::string_view text) {
  Allowance unlimited;
  return read_tab_file(text, unlimited).value();
}

CustomColumn column(Feature feature, std::string name, int over, int up_to, int upper_nm) {
  return {feature,
          std::move(name),
          {{{Length::millimetres(over), Length::millimetres(up_to)},
            {Length::nanometres(upper_nm), Length()}}}};
}

/// A reader that knows nothing of TabTable: the line of names gives the offsets.
std::string cell_by_offset(const std::string& file, const std::string& row,
                           const std::string& column) {
  std::istringstream lines(file);
  std::string line;
  std::size_t begin = std::string::npos;
  std::size_t end = std::string::npos;
  while (std::getline(lines, line)) {
    if (line.starts_with("NR ")) {
      begin = (line + " ").find(" " + column + " ") + 1;
      end = line.find_first_not_of(' ', begin + column.size());
    } else if (begin != std::string::npos && line.starts_with(row + " ")) {
      if (line.size() <= begin) return "";
      const std::string cell = line.substr(begin, end - begin);
      return cell.substr(0, cell.find_last_not_of(' ') + 1);
    }
  }
  return "no such row";
}

}  // namespace

TEST_CASE("rows 2i and 2i + 1 hold the end of range i and its deviations") {
  const TabTable holes = project(tables_with({}), Feature::Hole);
  CHECK(holes.row_count() == 82);
  CHECK(holes.columns()[0].name == "NR");
  CHECK(holes.columns()[1].name == "BEREICH");
  CHECK(holes.columns()[2].name == "D10");
  CHECK(holes.columns()[25].name == "R7");
  CHECK(holes.columns()[26].name == "A01");
  CHECK(*holes.number(0, "BEREICH") == 3.0);
  CHECK(*holes.number(12, "BEREICH") == 30.0);
  CHECK(*holes.number(13, "BEREICH") == 30.0);
  CHECK(*holes.number(45, "BEREICH") == 400.0);
  CHECK(*holes.number(81, "BEREICH") == 3150.0);
  CHECK(holes.number(13, "K9").error().code == ErrorCode::TableCellEmpty);
  CHECK(holes.number(0, "J9").error().code == ErrorCode::TableColumnMissing);
  CHECK(holes.number(82, "H7").error().code == ErrorCode::TableRowMissing);
  const TabTable shafts = project(tables_with({}), Feature::Shaft);
  CHECK(shafts.columns()[2].name == "d9");
  CHECK(shafts.columns()[24].name == "s7");
}

TEST_CASE("every cell reads back exactly, by our reader and by the offsets of the column line") {
  const ToleranceTables tables = tables_with({});
  for (const Feature feature : {Feature::Hole, Feature::Shaft}) {
    const TabTable projected = project(tables, feature);
    const std::string file = write_tab(projected);
    const TabTable read = read_again(file);
    CHECK(read == projected);
    std::size_t numbers = 0;
    for (const ClassId id : tables.classes(feature)) {
      const std::string name(tables.class_name(id));
      for (std::size_t i = 0; i < tables.ranges().size(); ++i) {
        const auto size = NominalSize::make(tables.ranges()[i].up_to).value();
        const auto deviations = tables.limit_deviations(size, id);
        const auto upper = read.number(static_cast<std::int64_t>(2 * i), name);
        const auto lower = read.number(static_cast<std::int64_t>(2 * i + 1), name);
        REQUIRE(upper.has_value() == deviations.has_value());
        if (!deviations) continue;
        // As a program computes it: the sum of doubles, rounded once to the nanometre.
        CHECK(*Length::nearest_mm(size.length().to_mm() + *upper / 1000) ==
              size.length() + deviations->upper);
        CHECK(*Length::nearest_mm(size.length().to_mm() + *lower / 1000) ==
              size.length() + deviations->lower);
        ++numbers;
      }
    }
    CHECK(numbers > 10'000);
    const std::string sample = feature == Feature::Hole ? "JS7" : "js13";
    for (const std::string row : {"0", "7", "13", "81"}) {
      CHECK(cell_by_offset(file, row, sample) == *read.text(std::stoi(row), sample));
    }
    CHECK(cell_by_offset(file, "13", "BEREICH") == "30");
  }
}

TEST_CASE("custom columns take the place of their class, or the last one") {
  const ToleranceTables tables = tables_with({column(Feature::Hole, "H7", 18, 30, 15'000),
                                              column(Feature::Hole, "Press_1", 0, 3150, 1'001),
                                              column(Feature::Hole, "Odd", 20, 40, 9'000)});
  const TabTable holes = project(tables, Feature::Hole);
  CHECK(holes.columns()[9].name == "H7");
  CHECK(holes.columns().back().name == "Press_1");
  CHECK(*holes.number(12, "H7") == 15.0);
  CHECK(holes.number(14, "H7").error().code == ErrorCode::TableCellEmpty);
  CHECK(*holes.number(80, "Press_1") == 1.001);
  CHECK(holes.columns().back().decimals == 3);
  // 20 to 40 mm holds all of 24 to 30 mm, but only parts of 18 to 24 mm.
  CHECK(holes.number(10, "Odd").error().code == ErrorCode::TableCellEmpty);
  CHECK(*holes.number(12, "Odd") == 9.0);
  CHECK(read_again(write_tab(holes)) == holes);
}

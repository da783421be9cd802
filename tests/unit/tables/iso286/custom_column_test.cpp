#include <doctest/doctest.h>

#include "tables/iso286/tolerance_tables.hpp"
#include "tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

namespace {

CustomRow row(int over, int up_to, int upper_um, int lower_um) {
  return {{Length::millimetres(over), Length::millimetres(up_to)},
          {Length::micrometres(upper_um), Length::micrometres(lower_um)}};
}

}  // namespace

TEST_CASE("a custom column named like a class of the standard answers from then on") {
  const auto tables =
      tables_with({{Feature::Hole, "H7", {row(18, 24, 15, -3), row(24, 30, 16, -4)}}});
  CHECK(deviations(tables, "25 H7") == "+16/-4");
  CHECK(deviations(tables, "24 H7") == "+15/-3");
  CHECK(deviations(tables, "18 H7") == "class.undefined_for_size");
  CHECK(deviations(tables, "30.000001 H7") == "class.undefined_for_size");
  CHECK(deviations(tables, "25 H6") == "+13/0");
  const auto limits = tables.limits_of_size(size_mm("25"), "H7").value();
  CHECK(word(limits.basis) == "custom");
  CHECK(limits.size_range.over == Length::millimetres(24));
  CHECK(tables.limits_of_size(size_mm("40"), "H7").error().message ==
        "H7 is not defined for 40 mm: the custom tolerance class covers sizes over 18 up to and "
        "including "
        "30 mm. The nearest class defined there is H6");
}

TEST_CASE("a custom column may have a name of its own, also without a grade") {
  const auto tables = tables_with({{Feature::Shaft, "press", {row(0, 50, 30, 20)}},
                                   {Feature::Hole, "H", {row(0, 3150, 100, -50)}}});
  CHECK(deviations(tables, "25 press") == "+30/+20");
  CHECK(deviations(tables, "25H") == "+100/-50");
  CHECK(deviations("25H") == "designation.malformed");
  CHECK(deviations(tables, "0.05 H") == "class.undefined_for_size");
  CHECK(deviations(tables, "0.051 H") == "+100/-50");
  const ClassId press = *tables.find_class("press");
  CHECK(tables.classes(Feature::Shaft).back() == press);
  CHECK(tables.classes(Feature::Hole).back() == *tables.find_class("H"));
  CHECK(tables.feature(press) == Feature::Shaft);
  CHECK(tables.basis(press) == Basis::Custom);
  CHECK_FALSE(tables.nearest_defined(size_mm("60"), press));
}

TEST_CASE("a class the standard never defines may be a custom column") {
  const auto tables = tables_with({{Feature::Hole, "J9", {row(18, 30, 26, -26)}}});
  CHECK(deviations(tables, "25 J9") == "+26/-26");
  CHECK(tables.basis(*tables.find_class("J9")) == Basis::Custom);
}

TEST_CASE("columns that are no columns are refused with their place") {
  const auto where = [](Feature feature, std::string name, std::vector<CustomRow> rows) {
    const auto checked = check_custom_column({feature, std::move(name), std::move(rows)});
    CHECK(checked.error().code == ErrorCode::TableRowsInvalid);
    REQUIRE_FALSE(checked.error().details.empty());
    return checked.error().details.front().where;
  };
  CHECK(check_custom_column({Feature::Hole, "H7", {row(18, 30, 15, -3)}}).has_value());
  CHECK(check_custom_column({Feature::Hole, "H7", {row(18, 30, 0, 0)}}).has_value());
  CHECK(where(Feature::Hole, "h7", {row(18, 30, 15, -3)}) == "/name");
  CHECK(where(Feature::Shaft, "H7", {row(18, 30, 15, -3)}) == "/name");
  CHECK(where(Feature::Hole, "7H", {row(18, 30, 15, -3)}) == "/name");
  CHECK(where(Feature::Hole, "NR", {row(18, 30, 15, -3)}) == "/name");
  CHECK(where(Feature::Hole, "BEREICH", {row(18, 30, 15, -3)}) == "/name");
  CHECK(where(Feature::Hole, "H7", {}) == "/rows");
  CHECK(where(Feature::Hole, "H7", {row(18, 30, -3, 15)}) == "/rows/0/upper_um");
  CHECK(where(Feature::Hole, "H7", {row(30, 30, 15, -3)}) == "/rows/0/up_to_mm");
  CHECK(where(Feature::Hole, "H7", {row(-1, 30, 15, -3)}) == "/rows/0/over_mm");
  CHECK(where(Feature::Hole, "H7", {row(18, 3151, 15, -3)}) == "/rows/0/up_to_mm");
  CHECK(where(Feature::Hole, "H7", {row(0, 18, 9, 0), row(24, 30, 9, 0)}) == "/rows/1/over_mm");
  CHECK(where(Feature::Hole, "H7", {row(0, 18, 9, 0), row(10, 30, 9, 0)}) == "/rows/1/over_mm");
}

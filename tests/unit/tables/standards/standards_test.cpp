#include <doctest/doctest.h>

#include "tables/standards/standard.hpp"

using namespace fitgauge;
using namespace fitgauge::standards;

namespace {

std::string text_of(std::string_view designation) {
  const auto limits = limits_of(designation);
  if (!limits) return std::string(id(limits.error().code));
  return fmt::format("{} {} {}", limits->designation(), format_um(limits->deviations.upper),
                     format_um(limits->deviations.lower));
}

const Row& row_for(const Table& table, std::int64_t millimetres) {
  for (const Row& row : table.rows) {
    if (row.holds(Length::millimetres(millimetres))) return row;
  }
  FAIL("no row");
  return table.rows.front();
}

}  // namespace

TEST_CASE("every standard names its edition, its sources and a revision of its numbers") {
  CHECK(all().size() == 4);
  for (const Standard& standard : all()) {
    CHECK(standard.sources.size() >= 2);
    CHECK(standard.revision.starts_with(standard.edition));
    CHECK(find(standard.name) == &standard);
    for (const Table& table : standard.tables) CHECK(!table.rows.empty());
  }
  CHECK(find("iso286") == nullptr);
}

// The table of DIN ISO 2768-1, typed a second time.
TEST_CASE("general tolerances are those of the table") {
  CHECK(text_of("0.5 ISO 2768-f") == "0.5 ISO 2768-f 50 -50");
  CHECK(text_of("3 ISO 2768-c") == "3 ISO 2768-c 200 -200");
  CHECK(text_of("3.1 ISO 2768-c") == "3.1 ISO 2768-c 300 -300");
  CHECK(text_of("25 ISO 2768-m") == "25 ISO 2768-m 200 -200");
  CHECK(text_of("30 ISO 2768-v") == "30 ISO 2768-v 1000 -1000");
  CHECK(text_of("120 ISO 2768-f") == "120 ISO 2768-f 150 -150");
  CHECK(text_of("400 ISO 2768-c") == "400 ISO 2768-c 1200 -1200");
  CHECK(text_of("1000 ISO 2768-m") == "1000 ISO 2768-m 800 -800");
  CHECK(text_of("2000 ISO 2768-v") == "2000 ISO 2768-v 6000 -6000");
  CHECK(text_of("4000 ISO 2768-m") == "4000 ISO 2768-m 2000 -2000");
  CHECK(text_of("12,5ISO 2768-m") == "12.5 ISO 2768-m 200 -200");
  CHECK(text_of("R5 ISO 2768-m") == "R5 ISO 2768-m 500 -500");
  CHECK(text_of("C2 ISO 2768-c") == "C2 ISO 2768-c 400 -400");
  CHECK(text_of("R100 ISO 2768-v") == "R100 ISO 2768-v 2000 -2000");
}

TEST_CASE("what ISO 2768-1 has no number for is refused") {
  CHECK(text_of("2 ISO 2768-v") == "class.undefined_for_size");
  CHECK(text_of("2500 ISO 2768-f") == "class.undefined_for_size");
  CHECK(text_of("4001 ISO 2768-m") == "class.undefined_for_size");
  CHECK(text_of("0.4 ISO 2768-m") == "class.undefined_for_size");
  CHECK(text_of("25 ISO 2768-k") == "class.unknown");
  CHECK(text_of("25 ISO 2768-mK") == "class.unknown");
  CHECK(limits_of("25 ISO 2768-mK").error().message.find("ISO 2768-2") != std::string::npos);
  for (const char* text : {"ISO 2768-m", "x ISO 2768-m", "-5 ISO 2768-m", "R5"}) {
    CHECK_MESSAGE(text_of(text) == "designation.malformed", text);
  }
}

TEST_CASE("angles have their tolerances in minutes") {
  const Table& angular = find("iso2768-1")->table("angular");
  constexpr std::array<std::array<std::int64_t, 4>, 5> kMinutes = {
      {{60, 60, 90, 180}, {30, 30, 60, 120}, {20, 20, 30, 60}, {10, 10, 15, 30}, {5, 5, 10, 20}}};
  for (std::size_t i = 0; i < kMinutes.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      CHECK(angular.rows[i].cells[2 * c].count == kMinutes[i][c]);
      CHECK(angular.rows[i].cells[2 * c + 1].count == -kMinutes[i][c]);
    }
  }
}

// As a catalogue of gear units prints DIN 6885-1 (Siemens MD 31.1, page 7/3).
TEST_CASE("keyways are those of a catalogue") {
  const Table& keyways = find("din6885-1")->table("keyways");
  struct Printed {
    std::int64_t shaft;
    double b;
    double h;
    double t1;
    double t2;
  };
  constexpr std::array<Printed, 13> kPrinted = {{{44, 12, 8, 5, 3.3},
                                                 {50, 14, 9, 5.5, 3.8},
                                                 {58, 16, 10, 6, 4.3},
                                                 {65, 18, 11, 7, 4.4},
                                                 {75, 20, 12, 7.5, 4.9},
                                                 {85, 22, 14, 9, 5.4},
                                                 {95, 25, 14, 9, 5.4},
                                                 {110, 28, 16, 10, 6.4},
                                                 {130, 32, 18, 11, 7.4},
                                                 {150, 36, 20, 12, 8.4},
                                                 {170, 40, 22, 13, 9.4},
                                                 {200, 45, 25, 15, 10.4},
                                                 {230, 50, 28, 17, 11.4}}};
  for (const Printed& printed : kPrinted) {
    const Row& row = row_for(keyways, printed.shaft);
    const auto mm = [&](std::string_view item) {
      return static_cast<double>(row.length(item, Member::Nominal)->count()) / 1e6;
    };
    CHECK(mm("width") == printed.b);
    CHECK(mm("height") == printed.h);
    CHECK(mm("shaft_depth") == printed.t1);
    CHECK(mm("hub_depth") == printed.t2);
  }
  // Both depths leave room for the key and a clearance above it.
  for (const Row& row : keyways.rows) {
    CHECK(*row.length("shaft_depth", Member::Nominal) + *row.length("hub_depth", Member::Nominal) >
          *row.length("height", Member::Nominal));
  }
}

// As makers print ISO 492 (gld-bearing.com, rajkot.com/srs, nodeshk.com), in µm below the nominal.
TEST_CASE("bearings are those of catalogues") {
  const Standard& bearings = *find("iso492");
  const auto lower = [&](std::string_view table, std::int64_t size, std::string_view item) {
    return -row_for(bearings.table(table), size).length(item, Member::Lower)->count() / 1'000;
  };
  constexpr std::array<std::array<std::int64_t, 4>, 9> kBores = {{{10, 8, 7, 5},
                                                                  {18, 8, 7, 5},
                                                                  {30, 10, 8, 6},
                                                                  {50, 12, 10, 8},
                                                                  {80, 15, 12, 9},
                                                                  {120, 20, 15, 10},
                                                                  {150, 25, 18, 13},
                                                                  {180, 25, 18, 13},
                                                                  {250, 30, 22, 15}}};
  for (const auto& [size, normal, p6, p5] : kBores) {
    CHECK(lower("bores", size, "normal") == normal);
    CHECK(lower("bores", size, "P6") == p6);
    CHECK(lower("bores", size, "P5") == p5);
  }
  constexpr std::array<std::array<std::int64_t, 3>, 9> kRings = {{{30, 9, 6},
                                                                  {50, 11, 7},
                                                                  {80, 13, 9},
                                                                  {120, 15, 10},
                                                                  {150, 18, 11},
                                                                  {180, 25, 13},
                                                                  {250, 30, 15},
                                                                  {315, 35, 18},
                                                                  {400, 40, 20}}};
  for (const auto& [size, normal, p5] : kRings) {
    CHECK(lower("outer_rings", size, "normal") == normal);
    CHECK(lower("outer_rings", size, "P5") == p5);
  }
  // Class 4 as NTN prints it for spindle bearings (bores) and GOST 520-2002, table 8 (outer rings).
  constexpr std::array<std::array<std::int64_t, 2>, 9> kFineBores = {
      {{10, 4}, {18, 4}, {30, 5}, {50, 6}, {80, 7}, {120, 8}, {150, 10}, {180, 10}, {250, 12}}};
  for (const auto& [size, p4] : kFineBores) CHECK(lower("bores", size, "P4") == p4);
  constexpr std::array<std::array<std::int64_t, 2>, 11> kFineRings = {{{6, 4},
                                                                       {18, 4},
                                                                       {30, 5},
                                                                       {50, 6},
                                                                       {80, 7},
                                                                       {120, 8},
                                                                       {150, 9},
                                                                       {180, 10},
                                                                       {250, 11},
                                                                       {315, 13},
                                                                       {400, 15}}};
  for (const auto& [size, p4] : kFineRings) CHECK(lower("outer_rings", size, "P4") == p4);
  for (const Table& table : bearings.tables) {
    for (const Row& row : table.rows) {  // the finer the class, the narrower, and all from 0
      if (const auto p4 = row.length("P4", Member::Lower)) {
        CHECK(*p4 >= *row.length("P5", Member::Lower));
      }
      CHECK(*row.length("P5", Member::Lower) >= *row.length("P6", Member::Lower));
      CHECK(*row.length("P6", Member::Lower) >= *row.length("normal", Member::Lower));
      CHECK(*row.length("normal", Member::Upper) == Length());
    }
  }
}

TEST_CASE("a file that breaks a rule is refused with its line") {
  const auto message = [](std::string_view csv) { return read_table("t", csv).error().message; };
  CHECK(message("over_mm,up_to_mm,m_lower_um\n1,2\n") == "line 2 of t has another number of cells");
  CHECK(message("over_mm,up_to_mm,m_um\n1,2,3\n").find("'3' for m_um") != std::string::npos);
  CHECK(message("over_mm,up_to_mm,m_plus_minus_um\n1,2,x\n").starts_with("line 2"));
  CHECK(
      message("over_mm,up_to_mm,m_plus_minus_um\n1,2,5\n3,4,5\n").starts_with("line 3"));  // a gap
  CHECK(message("over_mm,up_to_mm,m_upper_um,m_lower_um\n1,2,-5,5\n").starts_with("line 2"));
  CHECK(message("over_mm,up_to_mm,m_plus_minus_um\n").starts_with("line 1"));
}

TEST_CASE("designations of ISO 286 are none of these") {
  for (const char* text : {"25H7", "25 M6", "Ø25H7", "0.8js01", "H7"}) CHECK(!is_designation(text));
  CHECK(is_designation("M10-6H"));
  CHECK(is_designation("25 ISO 2768-m"));
  CHECK(is_designation(" M10-6H "));  // a field of fixed width
  for (const char* text : {" R5 ISO 2768-m ", "25 ISO 2768-m ", " M10-6H "})
    CHECK(limits_of(text).has_value());
  std::string text;
  append_designation(text, Length::millimetres(25), "M6");  // a class of ISO 286
  CHECK(text == "25 M6");
}

#include <doctest/doctest.h>

#include "tables/standards/standard.hpp"

using namespace fitgauge;
using namespace fitgauge::standards;

namespace {

/// `9.026 to 9.206`, or the code of the error.
std::string limits_text(std::string_view designation) {
  const auto limits = limits_of(designation);
  if (!limits) return std::string(id(limits.error().code));
  return fmt::format("{} to {}", format_mm(limits->lower_limit()),
                     format_mm(limits->upper_limit()));
}

}  // namespace

// Limits of the pitch diameter as tables of M threads by size print them
// (adrianschlatter/threadlib, design/metric_thread.csv; Yamawa's catalogue of 2021, page 646, for
// the grades 4H and 5H).
TEST_CASE("pitch diameters of threads have the published limits") {
  struct Published {
    std::string_view designation;
    std::string_view limits;
  };
  constexpr std::array<Published, 38> kPublished = {{
      {"M1.6-6H", "1.373 to 1.458"},      {"M1.6-6g", "1.291 to 1.354"},
      {"M2-6H", "1.74 to 1.83"},          {"M2-6g", "1.654 to 1.721"},
      {"M3-6H", "2.675 to 2.775"},        {"M3-6g", "2.58 to 2.655"},
      {"M4-6H", "3.545 to 3.663"},        {"M4-6g", "3.433 to 3.523"},
      {"M5-6H", "4.48 to 4.605"},         {"M5-6g", "4.361 to 4.456"},
      {"M6-6H", "5.35 to 5.5"},           {"M6-6g", "5.212 to 5.324"},
      {"M8-6H", "7.188 to 7.348"},        {"M8-6g", "7.042 to 7.16"},
      {"M8x1-6H", "7.35 to 7.5"},         {"M8x1-6g", "7.212 to 7.324"},
      {"M10-6H", "9.026 to 9.206"},       {"M10-6g", "8.862 to 8.994"},
      {"M10x1.25-6H", "9.188 to 9.348"},  {"M10x1.25-6g", "9.042 to 9.16"},
      {"M12-6H", "10.863 to 11.063"},     {"M12x1.5-6H", "11.026 to 11.216"},
      {"M14-6H", "12.701 to 12.913"},     {"M16-6H", "14.701 to 14.913"},
      {"M20x1.5-6H", "19.026 to 19.216"}, {"M24-6H", "22.051 to 22.316"},
      {"M24x2-6H", "22.701 to 22.925"},   {"M30-6H", "27.727 to 28.007"},
      {"M30x1.5-6H", "29.026 to 29.226"}, {"M33-6H", "30.727 to 31.007"},
      {"M3-4H", "2.675 to 2.738"},        {"M3-5H", "2.675 to 2.755"},
      {"M3-6G", "2.695 to 2.795"},        {"M6-4H", "5.35 to 5.445"},
      {"M6-5H", "5.35 to 5.468"},         {"M6-6G", "5.376 to 5.526"},
      {"M8-5H", "7.188 to 7.313"},        {"M8-6G", "7.216 to 7.376"},
  }};
  for (const Published& published : kPublished) {
    CHECK_MESSAGE(limits_text(published.designation) == published.limits, published.designation);
  }
}

TEST_CASE("every tolerance of the pitch diameter is that of the formulas, rounded to R 40") {
  constexpr std::array<int, 61> kR40 = {
      24,  25,  26,  28,  30,  32,  34,  36,  38,  40,  42,  45,  48,  50,  53,  56,
      60,  63,  67,  71,  75,  80,  85,  90,  95,  100, 106, 112, 118, 125, 132, 140,
      150, 160, 170, 180, 190, 200, 212, 224, 236, 250, 265, 280, 300, 315, 335, 355,
      375, 400, 425, 450, 475, 500, 530, 560, 600, 630, 670, 710, 750};
  // Of grade 6 (ISO 965-1, clause 13): the other grades in steps of R 10, internal ones 1.32 of it.
  constexpr std::array<double, 7> kExternal = {0.5, 0.63, 0.8, 1, 1.25, 1.6, 2};
  constexpr std::array<double, 5> kInternal = {0.85, 1.06, 1.32, 1.7, 2.12};
  const auto mm = [](Length length) { return static_cast<double>(length.count()) / 1e6; };
  std::size_t compared = 0;
  for (const Row& row : find("iso965-1")->table("pitch_diameters").rows) {
    const double d = std::sqrt(mm(*row.over) * mm(*row.up_to));
    const double six = 90 * std::pow(mm(*row.pitch), 0.4) * std::pow(d, 0.1);
    for (const Cell& cell : row.cells) {
      const auto grade = static_cast<std::size_t>(cell.item.back() - '0');
      const bool internal = cell.item.starts_with('i');
      const double exact = six * (internal ? kInternal.at(grade - 4) : kExternal.at(grade - 3));
      const auto um = static_cast<int>(cell.count / 1'000);
      CHECK_MESSAGE(std::find(kR40.begin(), kR40.end(), um) != kR40.end(), um);
      // The standard rounds by hand where the formula lies between two steps, of 6 % each.
      CHECK_MESSAGE(std::abs(um / exact - 1) < 0.061,
                    fmt::format("{} {} {}: {} for {:.1f}", mm(*row.up_to), mm(*row.pitch),
                                cell.item, um, exact));
      ++compared;
    }
  }
  CHECK(compared == 501);
}

TEST_CASE("positions of threads follow their formulas") {
  // es and EI of G, g: 15 + 11 P; e: 50 + 11 P; f: 30 + 11 P, in whole µm and rounded further.
  const auto check = [](const Row& row, std::string_view position, double base) {
    const auto deviation = row.length(position, Member::Deviation);
    if (!deviation) return;
    const double pitch = static_cast<double>(row.pitch->count()) / 1e6;
    const double um = std::abs(static_cast<double>(deviation->count())) / 1e3;
    CHECK_MESSAGE(std::abs(um - (base + 11 * pitch)) < 5.6, position);
  };
  for (const Row& row : find("iso965-1")->table("positions").rows) {
    check(row, "G", 15);
    check(row, "g", 15);
    check(row, "e", 50);
    check(row, "f", 30);
    CHECK(*row.length("G", Member::Deviation) == -*row.length("g", Member::Deviation));
  }
}

TEST_CASE("threads are read in the forms drawings use") {
  const auto designation = [](std::string_view text) { return limits_of(text)->designation(); };
  CHECK(designation("M10-6H") == "M10-6H");
  CHECK(designation("M10x1.5-6H") == "M10-6H");  // the coarse pitch is left out
  CHECK(designation("M10×1,25-6g") == "M10x1.25-6g");
  CHECK(designation("M10X1-5g6g") == "M10x1-5g6g");
  CHECK(limits_text("M10x1-5g6g") == limits_text("M10x1-5g"));  // the first is the pitch diameter's
  CHECK(limits_of("M10-6H")->feature == iso286::Feature::Hole);
  CHECK(limits_of("M10-6g")->feature == iso286::Feature::Shaft);
  CHECK(limits_of("M10-6H")->standard->edition == "ISO 965-1:2013");
}

TEST_CASE("what is no thread is refused with the reason") {
  for (const char* text : {"M10", "M10-", "M10-6", "M10-6HH", "M-6H", "M10x-6H", "M10-6H5g",
                           "M10-6H6H6H", "M10x1x1-6H", "M0-6H", "M10-5g9z", "M10-6H-LH"}) {
    CHECK_MESSAGE(limits_text(text) == "designation.malformed", text);
  }
  CHECK(limits_text("M10-6k") == "class.unknown");
  CHECK(limits_text("M10-2H") == "class.undefined_for_size");  // no such grade
  CHECK(limits_text("M10x0.35-6H") ==
        "class.undefined_for_size");                               // no such pitch at this diameter
  CHECK(limits_text("M10.3x1-6H") == "class.undefined_for_size");  // not of ISO 261
  CHECK(limits_text("M15-6H") == "class.undefined_for_size");      // no coarse pitch
  CHECK(limits_text("M1x0.25-6e") == "class.undefined_for_size");  // no such position at this pitch
  CHECK(limits_text("M10.0000001-6H") == "length.too_fine");
}

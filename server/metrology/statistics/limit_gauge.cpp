#include "metrology/statistics/limit_gauge.hpp"

#include "tables/compiled_in.hpp"
#include "tables/iso286/derivation.hpp"

namespace fitgauge::metrology {
namespace {

using iso286::Feature;
using iso286::LimitDeviations;
using iso286::StandardToleranceGrade;

constexpr int kIt1 = static_cast<int>(StandardToleranceGrade::IT1);

/// The tolerance of a gauge for a part of this grade: H of a plug, H1 of a ring or snap gauge.
Length tolerance_of_gauge(Feature feature, int grade, const iso286::NominalSizeRange& step) {
  static const iso286::StandardTables standard(iso286::compiled_in_tables().cells);
  const bool is_hole = feature == Feature::Hole;
  int made_to = is_hole ? 2 + (grade >= 7) : 2 + (grade >= 6) + (grade >= 8);
  if (grade >= 11) made_to = grade >= 13 ? 7 : 5;
  const auto as_grade = static_cast<StandardToleranceGrade>(made_to - 1 + kIt1);
  return standard_tolerance(standard, as_grade, step).value();
}

LimitDeviations about(Length centre, Length tolerance) {
  const Length half = Length::nanometres(tolerance.count() / 2);
  return {.upper = centre + half, .lower = centre - half};
}

Error without_value(std::string message) {
  return {ErrorCode::ClassUndefinedForSize, std::move(message)};
}

}  // namespace

const standards::Table& limit_gauge_table() {
  static const standards::Table table =
      standards::read_table("gauges", compiled_in_csv("iso1938_gauges")).value();
  return table;
}

Result<LimitGauge> limit_gauge(const iso286::LimitsOfSize& limits, std::string_view class_name) {
  const auto& steps = limit_gauge_table().rows;
  const auto row = std::ranges::find_if(
      steps, [&](const standards::Row& step) { return step.holds(limits.nominal_size.length()); });
  if (row == steps.end()) {
    return Error{ErrorCode::SizeOutOfRange,
                 "the nominal size of a limit gauge must be at most 500 mm"};
  }
  const auto standard = iso286::class_from_name(class_name);
  if (!standard || limits.basis != iso286::Basis::Iso286) {
    return without_value(
        fmt::format("{} is a custom tolerance class: limit gauges need a standard tolerance grade",
                    class_name));
  }
  const int grade = static_cast<int>(standard->grade) - kIt1 + 1;
  const bool is_hole = limits.feature == Feature::Hole;
  const int finest = is_hole ? 6 : 5;
  if (grade < finest || grade > 16) {
    return without_value(fmt::format("{} has no gauge for {}: a {} must have IT{} to IT16",
                                     kLimitGaugeScheme, class_name, word(limits.feature), finest));
  }
  const auto value = [&](std::string_view name, int of) {
    return row->length(fmt::format("{}_{}", name, of), standards::Member::Deviation);
  };
  const bool is_shaft_6 = !is_hole && grade == 6;
  const auto inset = value("inset", is_shaft_6 ? 7 : grade);
  if (!inset) {
    return without_value(
        "the sources disagree about gauges for shafts of IT5 over 250 up to 315 mm");
  }
  const Length wear = value(is_shaft_6 ? "shaft_wear" : "wear", grade).value_or(Length());
  const Length safety = value("safety", grade).value_or(Length());
  const Length tolerance = tolerance_of_gauge(limits.feature, grade, {*row->over, *row->up_to});
  if (is_hole) {
    return LimitGauge{.go = about(limits.lower_limit() + *inset, tolerance),
                      .go_wear_limit = limits.lower_limit() - wear + safety,
                      .no_go = about(limits.upper_limit() - safety, tolerance)};
  }
  return LimitGauge{.go = about(limits.upper_limit() - *inset, tolerance),
                    .go_wear_limit = limits.upper_limit() + wear - safety,
                    .no_go = about(limits.lower_limit() + safety, tolerance)};
}

}  // namespace fitgauge::metrology

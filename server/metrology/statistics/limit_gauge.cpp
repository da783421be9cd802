#include "metrology/statistics/limit_gauge.hpp"

namespace fitgauge::metrology {
namespace {

using iso286::Feature;
using iso286::LimitDeviations;
using iso286::StandardToleranceGrade;

constexpr std::int64_t kTenth = 100;  // nanometres

int number_of(StandardToleranceGrade grade) {
  return static_cast<int>(grade) - static_cast<int>(StandardToleranceGrade::IT1) + 1;
}

std::size_t step_of(iso286::NominalSize size) {
  std::size_t step = 0;
  while (size.length() > Length::millimetres(kGaugeSteps[step])) ++step;
  return step;
}

/// The grade a gauge for this grade is made to: H of a plug, H1 of a ring or snap gauge.
int grade_of_gauge(Feature feature, int grade) {
  if (grade >= 13) return 7;
  if (grade >= 11) return 5;
  if (feature == Feature::Hole) return grade >= 7 ? 3 : 2;
  return grade >= 8 ? 4 : grade >= 6 ? 3 : 2;
}

/// The values of one grade and step.
struct Values {
  Length inset;
  Length wear;
  Length safety;
  Length tolerance;
};

Length tenths(std::int16_t value) { return Length::nanometres(value * kTenth); }

Values values_of(Feature feature, int grade, std::size_t step) {
  const int made_to = grade_of_gauge(feature, grade);
  Values values;
  values.tolerance =
      tenths(made_to == 7 ? kTolerance7[step]
                          : kFineTolerances[static_cast<std::size_t>(made_to - 1)][step]);
  if (grade == 5) {
    values.inset = tenths(kShaft5.inset[step]);
    values.wear = tenths(kShaft5.wear[step]);
    values.safety = tenths(kShaft5.safety[step]);
    return values;
  }
  const auto row = static_cast<std::size_t>(grade - 6);
  const bool shaft_6 = feature == Feature::Shaft && grade == 6;
  values.inset = tenths(kInset[shaft_6 ? row + 1 : row][step]);
  if (row < kWear.size()) values.wear = tenths(shaft_6 ? kShaftWear6[step] : kWear[row][step]);
  values.safety = tenths(kSafety[row][step]);
  return values;
}

LimitDeviations about(Length centre, Length tolerance) {
  const Length half = Length::nanometres(tolerance.count() / 2);
  return {.upper = centre + half, .lower = centre - half};
}

Error without_value(std::string message) {
  return {ErrorCode::ClassUndefinedForSize, std::move(message)};
}

}  // namespace

Result<LimitGauge> limit_gauge(const iso286::LimitsOfSize& limits, std::string_view class_name) {
  if (limits.nominal_size.length() > Length::millimetres(kGaugeSteps.back())) {
    return Error{ErrorCode::SizeOutOfRange,
                 "the nominal size of a limit gauge must be at most 500 mm"};
  }
  const auto standard = iso286::class_from_name(class_name);
  if (!standard || limits.basis != iso286::Basis::Iso286) {
    return without_value(
        fmt::format("{} is a custom tolerance class: limit gauges need a standard tolerance grade",
                    class_name));
  }
  const int grade = number_of(standard->grade);
  const int finest = limits.feature == Feature::Hole ? 6 : 5;
  if (grade < finest || grade > 16) {
    return without_value(fmt::format("{} has no gauge for {}: a {} must have IT{} to IT16",
                                     kLimitGaugeScheme, class_name, word(limits.feature), finest));
  }
  const std::size_t step = step_of(limits.nominal_size);
  if (grade == 5 && kShaft5.inset[step] == kNoGaugeValue) {
    return without_value(
        "the sources disagree about gauges for shafts of IT5 over 250 up to 315 mm");
  }
  const Values v = values_of(limits.feature, grade, step);
  if (limits.feature == Feature::Hole) {
    return LimitGauge{.go = about(limits.lower_limit() + v.inset, v.tolerance),
                      .go_wear_limit = limits.lower_limit() - v.wear + v.safety,
                      .no_go = about(limits.upper_limit() - v.safety, v.tolerance)};
  }
  return LimitGauge{.go = about(limits.upper_limit() - v.inset, v.tolerance),
                    .go_wear_limit = limits.upper_limit() + v.wear - v.safety,
                    .no_go = about(limits.lower_limit() + v.safety, v.tolerance)};
}

}  // namespace fitgauge::metrology

#include "metrology/statistics/limit_gauge.hpp"

#include <doctest/doctest.h>

#include "metrology/statistics/fit_analysis.hpp"
#include "unit/tables/iso286/tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;
using iso286::size_mm;
using iso286::standard_tables;

namespace {

Result<LimitGauge> gauge(const char* mm, const char* name) {
  return limit_gauge(standard_tables().limits_of_size(size_mm(mm), name).value(), name);
}

std::string text(const LimitGauge& g) {
  return format_mm(g.go.lower) + ' ' + format_mm(g.go.upper) + ' ' + format_mm(g.go_wear_limit) +
         ' ' + format_mm(g.no_go.lower) + ' ' + format_mm(g.no_go.upper);
}

iso286::Fit fit(const char* mm, const char* hole, const char* shaft) {
  return standard_tables()
      .fit(size_mm(mm), standard_tables().find_class(hole).value(),
           standard_tables().find_class(shaft).value())
      .value();
}

}  // namespace

TEST_CASE("sizes of limit gauges, worked out by hand from the formulas of the scheme") {
  // z 3, y 3, H 4: GO 25.003 ± 0.002, worn 24.997; NO-GO 25.021 ± 0.002.
  CHECK(text(gauge("25", "H7").value()) == "25.001 25.005 24.997 25.019 25.023");
  // g6 is 24.980 to 24.993; z1 of IT7 3, y1 3, H1 4.
  CHECK(text(gauge("25", "g6").value()) == "24.988 24.992 24.996 24.978 24.982");
  // 200 H7 is 200 to 200.046; z 7, y 6, alpha 3, H 10: the safety zone moves worn and NO-GO in.
  CHECK(text(gauge("200", "H7").value()) == "200.002 200.012 199.997 200.038 200.048");
  // 10 H9: 0 to 36; z 7, no wear beyond the limit, H 2.5.
  CHECK(text(gauge("10", "H9").value()) == "10.00575 10.00825 10 10.03475 10.03725");
}

TEST_CASE("where there is no gauge, the error says why") {
  CHECK(gauge("501", "H7").error().code == ErrorCode::SizeOutOfRange);
  CHECK(gauge("500", "H7").has_value());
  CHECK(gauge("25", "H5").error().code == ErrorCode::ClassUndefinedForSize);
  CHECK(gauge("25", "h5").has_value());
  CHECK(gauge("25", "h4").error().code == ErrorCode::ClassUndefinedForSize);
  CHECK(gauge("25", "H17").error().code == ErrorCode::ClassUndefinedForSize);
  CHECK(gauge("300", "h5").error().code == ErrorCode::ClassUndefinedForSize);
  CHECK(gauge("316", "h5").has_value());
}

TEST_CASE("the tables of gauges hold what they must") {
  const auto& steps = limit_gauge_table().rows;
  REQUIRE(steps.size() == 13);
  const auto value = [](const standards::Row& row, const char* name, int grade) {
    return row.length(fmt::format("{}_{}", name, grade), standards::Member::Deviation).value();
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CAPTURE(i);
    const auto& step = steps[i];
    const auto nominal = iso286::NominalSize::make(step.up_to.value()).value();
    // A coarser grade and a larger size never have less; the new GO gauge lies inside its limit.
    for (int grade = 6; grade <= 16; ++grade) {
      CAPTURE(grade);
      for (const char* name : {"inset", "safety"}) {
        const Length here = value(step, name, grade);
        if (grade > 6) CHECK(here >= value(step, name, grade - 1));
        if (i > 0) CHECK(here >= value(steps[i - 1], name, grade));
      }
      const std::string name = "H" + std::to_string(grade);
      const auto limits = standard_tables().limits_of_size(nominal, name);
      if (!limits) continue;
      const LimitGauge made = limit_gauge(*limits, name).value();
      CHECK(made.go.lower > limits->lower_limit());
      CHECK(made.go_wear_limit < made.go.lower);
      CHECK(made.go.upper < made.no_go.lower);
    }
  }
}

TEST_CASE("the probability of interference, worst case beside it") {
  // 25 H7/k6: hole 0 to 21, shaft 2 to 15; mean clearance 2, sigma sqrt(21^2 + 13^2) / 6.
  const FitProbabilities found = probability_of_interference(fit("25", "H7", "k6"));
  CHECK(found.normal == Approx(std::erfc(2 / (std::hypot(21, 13) / 6) / std::sqrt(2)) / 2));
  // Uniform: P(h - s < 0) by area, s from 2 to 15 over h from 0 to 21: E[s] / 21.
  CHECK(found.uniform == Approx(8.5 / 21));
  CHECK(probability_of_interference(fit("25", "H7", "g6")).uniform == 0);
  CHECK(probability_of_interference(fit("25", "H7", "s6")).uniform == 1);
}

TEST_CASE("fits are found within their bounds, the preferred first") {
  const ClearanceBounds bounds{Length::micrometres(5), Length::micrometres(45)};
  const auto found = find_fits(standard_tables(), size_mm("25"), bounds);
  REQUIRE(found.size() > 10);
  CHECK(found[0].preferred);
  bool ordinary = false;
  bool has_h7_g6 = false;
  for (const FoundFit& each : found) {
    CHECK(each.least >= bounds.least);
    CHECK(each.most <= bounds.most);
    CHECK_FALSE((each.preferred && ordinary));
    ordinary = ordinary || !each.preferred;
    has_h7_g6 = has_h7_g6 || (standard_tables().class_name(each.hole) == "H7" &&
                              standard_tables().class_name(each.shaft) == "g6");
  }
  CHECK(has_h7_g6);  // 7 to 41
  CHECK(is_preferred("H7", "g6"));
  CHECK(is_preferred("G7", "h6"));
  CHECK(is_preferred("S7", "h6"));
  CHECK(is_preferred("D9", "h9"));
  CHECK_FALSE(is_preferred("H7", "g7"));
  CHECK_FALSE(is_preferred("G8", "h6"));
  CHECK_FALSE(is_preferred("H7", "6"));
  CHECK(
      find_fits(standard_tables(), size_mm("25"), {Length::micrometres(1), Length::micrometres(1)})
          .empty());
}

TEST_CASE("a press fit by Lame") {
  // A solid steel shaft in a steel hub of twice its diameter: p = E * U / (2 d) * (1 - (d / D)^2).
  PressFit fit;
  fit.joint_diameter_mm = 50;
  fit.length_mm = 40;
  fit.friction = 0.1;
  fit.hub.other_diameter_mm = 100;
  const Pressure pressed = press(fit, 40).value();
  CHECK(pressed.pressure_mpa == Approx(210000 * 0.040 / (2 * 50) * (1 - 0.25)).epsilon(1e-12));
  CHECK(pressed.axial_force_n == Approx(0.1 * pressed.pressure_mpa * M_PI * 50 * 40));
  CHECK(pressed.torque_nm == Approx(pressed.axial_force_n * 0.025));
  fit.hub.rz_um = 6.3;
  fit.shaft.rz_um = 3.7;
  CHECK(press(fit, 40).value().effective_um == Approx(36));  // 0.4 * 10 less
  CHECK(press(fit, 3).value().pressure_mpa == 0);
  fit.hub.other_diameter_mm = 50;
  CHECK(press(fit, 40).error().code == ErrorCode::FieldInvalid);
}

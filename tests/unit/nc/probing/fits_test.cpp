#include "nc/probing/touch/fits.hpp"

#include <doctest/doctest.h>

namespace fitgauge::probing {
namespace {

Circle fit(std::span<const machine::Vec3> points) {
  const auto circle = fit_circle(points);
  REQUIRE(circle.has_value());
  return *circle;
}

}  // namespace

TEST_CASE("four and more points: the geometric fit of a published example") {
  // Gander, Golub and Strebel, Least-squares fitting of circles and ellipses (1994), section 5.
  constexpr std::array<machine::Vec3, 6> kPoints{{{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}}};
  const Circle circle = fit(kPoints);
  CHECK(std::abs(circle.centre.x - 4.7397824109) < 1e-10);
  CHECK(std::abs(circle.centre.y - 2.9835326993) < 1e-10);
  CHECK(std::abs(circle.radius - 4.7142260378) < 1e-10);
  CHECK(circle.residual > 0.5);
}

TEST_CASE("points on a circle give it back, also on a short arc far from the origin") {
  for (const double step_deg : {5.0, 30.0, 90.0, 120.0}) {
    for (const int count : {3, 4, 8}) {
      if (step_deg * count > 360) continue;
      CAPTURE(step_deg);
      CAPTURE(count);
      std::vector<machine::Vec3> points;
      for (int i = 0; i < count; ++i) {
        const double angle = (17 + step_deg * i) * std::acos(-1.0) / 180;
        points.push_back({400 + 12.5 * std::cos(angle), -300 + 12.5 * std::sin(angle)});
      }
      const Circle circle = fit(points);
      // A short arc amplifies the rounding of the coordinates.
      const double tolerance = step_deg < 30 ? 1e-9 : 1e-11;
      CHECK(std::abs(circle.centre.x - 400) < tolerance);
      CHECK(std::abs(circle.centre.y + 300) < tolerance);
      CHECK(std::abs(circle.radius - 12.5) < tolerance);
      CHECK(circle.residual < 1e-12);
    }
  }
}

TEST_CASE("points that make no circle are contradictory") {
  const std::vector<machine::Vec3> two{{0, 0}, {1, 0}};
  const std::vector<machine::Vec3> line{{0, 0}, {1, 1}, {2, 2}, {5, 5}};
  const std::vector<machine::Vec3> same{{3, 3}, {3, 3}, {3, 3}};
  for (const auto& points : {two, line, same}) {
    const auto circle = fit_circle(points);
    REQUIRE(circle.has_error());
    CHECK(circle.error().number == 1081);
  }
}

TEST_CASE("what the scatter of touches makes of a diameter") {
  const auto factor = [](int points, double step_deg) {
    std::vector<machine::Vec3> touched;
    for (int k = 0; k < points; ++k) {
      const double angle = k * step_deg * std::acos(-1.0) / 180;
      touched.push_back({100 + 12 * std::cos(angle), 12 * std::sin(angle)});
    }
    return fit_circle(touched)->diameter_factor;
  };
  CHECK(factor(4, 90) == doctest::Approx(1));
  CHECK(factor(3, 120) == doctest::Approx(2 / std::sqrt(3)));
  // Found by drawing noise for a review: 1 um becomes 0.26 and 0.64 mm, with 30 degrees 6.5, 17 um.
  CHECK(factor(4, 5) == doctest::Approx(260).epsilon(0.02));
  CHECK(factor(3, 5) == doctest::Approx(640).epsilon(0.02));
  CHECK(factor(4, 30) == doctest::Approx(6.5).epsilon(0.1));
  CHECK(factor(3, 30) == doctest::Approx(17).epsilon(0.1));
}

TEST_CASE("points that show no plane or no cylinder have none") {
  using Points = std::vector<machine::Vec3>;
  const machine::Vec3 up{0, 0, 1};
  const Points corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  CHECK_FALSE(fit_plane(Points{{0, 0, 0}, {1, 0, 0}}, up));
  CHECK_FALSE(fit_plane(Points{{3, 3, 3}, {3, 3, 3}, {3, 3, 3}}, up));
  CHECK_FALSE(fit_plane(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, up));
  CHECK_FALSE(fit_plane(corners, up));
  CHECK(fit_plane(Points{{0, 0, 7}, {1, 0, 7}, {0, 1, 7}}, -up)->normal.z == -1);

  const FittedCylinder near{{0.5, 0.5, 0}, up, 0.7};
  const auto found = fit_cylinder(corners, near);
  REQUIRE(found);
  CHECK(norm(found->point - machine::Vec3{0.5, 0.5, 0.5}) < 1e-12);
  CHECK(std::abs(found->radius - std::sqrt(0.5)) < 1e-12);
  CHECK_FALSE(fit_cylinder(Points(corners.begin(), corners.begin() + 4), near));
  Points section;
  for (int k = 0; k < 8; ++k) section.push_back({std::cos(k), std::sin(k), 4});
  CHECK_FALSE(fit_cylinder(section, {{0, 0, 0}, up, 1}));
  CHECK_FALSE(fit_cylinder(Points(6, {1, 1, 1}), near));
}

}  // namespace fitgauge::probing

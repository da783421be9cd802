#include "nc/probing/cycles.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/object/object_cycle.hpp"
#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing::cycle_1401_1411 {

using namespace parameter;

constexpr std::array kCentre = join(kPoint1, std::array{dimension(1116, "Diameter")});
constexpr std::array kTouched =
    join(std::array{choice(423, "Number of touches", 3, 8, 3), angle(325, "Starting angle", 360, 0),
                    angle(1119, "Angular length", 360, 360)},
         kObject);
constexpr std::array kEnd = join(kTouched, std::array{transfer_position(1)});
constexpr std::array k1401 =
    join(join(kCentre, std::array{choice(1115, "Geometry: 0 hole, 1 stud", 0, 1, 0)}), kEnd);
constexpr std::array k1402 = join(kCentre, kEnd);
constexpr std::array k1411 = join(
    join(join(kCentre, kPoint2),
         std::array{dimension(1117, "2nd diameter"),
                    choice(1115, "Geometry: 0 holes, 1 studs, 2 hole and stud, 3 stud and hole", 0,
                           3, 0)}),
    join(kTouched, transfer_all(3, 2)));

constexpr auto kOneResults = object_results<1>(std::array{kDiameterResult});
constexpr auto kTwoResults =
    object_results<2>(std::array{kDiameterResult, CycleOutput{967, "2nd diameter", Unit::Length},
                                 kAngleResult, kTableAngleResult});

/// A circle to be touched.
struct ObjectCircle {
  Side side;
  ObjectPoint point;
  Nominal diameter;
  std::vector<Touch> touches;

  MeasuredValue size(double radius, int result) const {
    return {.characteristic = result == 966 ? "Diameter" : "2nd diameter",
            .role = size_role(side),
            .nominal = diameter.target,
            .measured = to_length(2 * radius),
            .limits = diameter.limits,
            .result_q = static_cast<std::uint16_t>(result),
            .deviation_q = static_cast<std::uint16_t>(result + 30)};
  }
};

CycleResult<ObjectCircle> circle_of(const ObjectProbing& probing, Side side, int first,
                                    int diameter) {
  const auto point = TRY(probing.point(first));
  const auto nominal = TRY(probing.size(diameter));
  const Arguments& arguments = probing.arguments();
  const double sweep = arguments.number(1119);
  const int points = arguments.whole(423);
  return ObjectCircle{
      side, point, nominal,
      circle_touches({.side = side,
                      .centre = {point.nominal.x, point.nominal.y},
                      .diameter = nominal.target.to_mm(),
                      .start_angle = arguments.number(325),
                      .step = sweep / (std::abs(sweep) == 360 ? points : points - 1),
                      .points = points,
                      .height = point.nominal.z,
                      .start_distance = probing.start_distance()})};
}

/// Q1115 with the other side at one circle: 0 holes, 1 studs, 2 hole and stud, 3 stud and hole.
constexpr int other_geometry(int geometry, std::size_t circle, std::size_t circles) {
  constexpr int kOther[][2] = {{3, 2}, {2, 3}, {1, 0}, {0, 1}};
  return circles == 1 ? 1 - geometry : kOther[geometry][circle];
}

/// One or two circles in the plane.
CycleResult<void> probe_circles(const CycleContext& context) {
  auto probing = TRY(ObjectProbing::begin(context));
  const int geometry = context.arguments.whole(1115);
  const std::array sides{geometry == 0 || geometry == 2 ? Side::Inside : Side::Outside,
                         geometry == 0 || geometry == 3 ? Side::Inside : Side::Outside};
  const int count = context.arguments.descriptor().number == 1411 ? 2 : 1;
  std::vector<ObjectCircle> circles;
  std::vector<std::vector<Touch>> objects;
  for (int i = 0; i < count; ++i) {
    const auto circle =
        TRY(circle_of(probing, sides.at(static_cast<std::size_t>(i)), 1100 + 3 * i, 1116 + i));
    circles.push_back(circle);
    objects.push_back(circle.touches);
  }
  const Vec3 nominal = circles.back().point.nominal - circles.front().point.nominal;
  if (count == 2 && nominal.x == 0 && nominal.y == 0) {
    return nc_error(1081, "both centres are the same");
  }
  const auto touched = probing.touch(objects);
  if (!touched) {
    std::vector<PlannedPlace> places;
    for (std::size_t i = 0; i < circles.size(); ++i)
      places.push_back(
          {.side = sides.at(i),
           .centre = circles[i].point.nominal,
           .other_side = fmt::format("Q1115 = {}", other_geometry(geometry, i, circles.size()))});
    return with_part(touched.error(), context, probing.motion().plane(), places);
  }
  ObjectFound found;
  std::span<const Contact> left = *touched;
  for (ObjectCircle& object : circles) {
    const auto own = left.first(object.touches.size());
    left = left.subspan(own.size());
    const auto circle = TRY(circle_through(own, object.side, probing.motion().ball_radius()));
    object.point.measured.x = circle.centre.x;
    object.point.measured.y = circle.centre.y;
    found.sizes.push_back(object.size(circle.radius, found.points.empty() ? 966 : 967));
    found.points.push_back(object.point);
    if (count > 1) continue;
    found.form = circle_form(ball_centres(own), circle, context.arguments.number(325));
    found.form->touch_uncertainty_um = probing.motion().touch_uncertainty_um();
  }
  const Vec3 measured = found.points.back().measured - found.points.front().measured;
  if (count == 2)
    add_line(found, probing, {nominal.x, nominal.y, 0}, {measured.x, measured.y, 0}, true);
  return probing.finish(found);
}

CycleResult<void> probe_sphere(const CycleContext& context) {
  auto probing = TRY(ObjectProbing::begin(context));
  auto object = TRY(circle_of(probing, Side::Outside, 1100, 1116));
  const Vec3 centre = object.point.nominal;
  const double half = object.diameter.target.to_mm() / 2;
  object.touches.push_back(probing.towards(centre + Vec3{0, 0, half}, {0, 0, -1}));
  object.touches.back().transit = Transit::ClearanceHeight;
  const auto contacts = TRY(probing.touch({object.touches}));
  const double ball = probing.motion().ball_radius();
  const auto sphere = fit_sphere(centres_in_space(contacts), {centre, half + ball});
  if (!sphere) return nc_error(1081, "no sphere passes near the touched points");
  object.point.measured = sphere->centre;
  return probing.finish(
      {.points = {object.point}, .sizes = {object.size(sphere->radius - ball, 966)}});
}

constinit const TouchProbeCycle kCycle1401 =
    object_cycle(1401, "CIRCLE PROBING", k1401, kOneResults, {1081}, probe_circles);
constinit const TouchProbeCycle kCycle1402 =
    object_cycle(1402, "SPHERE PROBING", k1402, kOneResults, {1081}, probe_sphere);
constinit const TouchProbeCycle kCycle1411 =
    object_cycle(1411, "PROBING TWO CIRCLES", k1411, kTwoResults, {1081, 1100}, probe_circles);

}  // namespace fitgauge::probing::cycle_1401_1411

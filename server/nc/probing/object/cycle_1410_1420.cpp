#include "nc/machine/tolerance.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/object/object_cycle.hpp"

namespace fitgauge::probing::cycle_1410_1420 {

using namespace parameter;

constexpr std::array kPoints = join(kPoint1, kPoint2);
constexpr std::array kEnd = join(std::array{kObjectDirection}, kObject);
constexpr std::array k1410 = join(join(kPoints, kEnd), transfer_all(3, 2));
constexpr std::array k1412 =
    join(join(kPoint1,
              std::array{
                  CycleParameter{.id = q(400),
                                 .meaning = "Tolerance across the line, such as \"0.4-0.1\"",
                                 .kind = ValueKind::Text,
                                 .required = false},
                  angle(1130, "Nominal angle of the line"),
                  choice(1131, "Probing direction: the line turned by +1 or -1 right angle", -1, 1),
                  coordinate(1132, "1st distance along the line"),
                  coordinate(1133, "2nd distance along the line"),
                  choice(1139, "Plane of the line: 1 YZ, 2 ZX, 3 XY", 1, 3, 3)}),
         join(kObject, transfer_all(1, 2)));
constexpr std::array k1420 =
    join(join(kPoints, std::array{dimension(1106, "3rd point, main axis"),
                                  dimension(1107, "3rd point, secondary axis"),
                                  dimension(1108, "3rd point, probe axis")}),
         join(kEnd, transfer_all(4, 1)));

constexpr auto kLineResults = object_results<2>(std::array{kAngleResult, kTableAngleResult});
constexpr std::array kSpatial{CycleOutput{961, "Spatial angle A", Unit::Angle},
                              CycleOutput{962, "Spatial angle B", Unit::Angle},
                              CycleOutput{963, "Spatial angle C", Unit::Angle}};
constexpr auto kPlaneResults = object_results<3>(kSpatial);

/// Touches two points of a line. A level line is in the working plane.
CycleResult<ObjectFound> touch_line(ObjectProbing& probing, ObjectPoint first, ObjectPoint second,
                                    const Vec3& direction, bool is_level) {
  const auto line = [&](Vec3 from, Vec3 to) {
    if (is_level) from.z = to.z;
    return to - from;
  };
  const Vec3 nominal = line(first.nominal, second.nominal);
  if (norm(cross(nominal, direction)) <= tolerance::kCollinear * (1 + norm(nominal))) {
    return nc_error(1081, "both points lie at the same place of the line");
  }
  const auto contacts = TRY(probing.touch(
      {{probing.towards(first.nominal, direction), probing.towards(second.nominal, direction)}}));
  const Vec3 measured = line(contacts.front().ball_centre, contacts.back().ball_centre);
  const Vec3 along = unit(measured);
  const Vec3 normal = unit(direction - along * dot(direction, along));
  const double ball = probing.motion().ball_radius();
  first.touch(face_behind(contacts.front(), direction, normal, ball), direction);
  second.touch(face_behind(contacts.back(), direction, normal, ball), direction);
  ObjectFound found{.points = {first, second}};
  add_line(found, probing, nominal, measured, is_level);
  return found;
}

CycleResult<void> probe_edge(const CycleContext& context) {
  const auto direction = TRY(object_direction(context.arguments));
  auto probing = TRY(ObjectProbing::begin(context));
  const auto first = TRY(probing.point(1100));
  const auto second = TRY(probing.point(1103));
  const auto found = touch_line(probing, first, second, direction, direction.z == 0);
  return found ? probing.finish(*found) : found.error();
}

CycleResult<std::optional<Limits>> tolerance_of(const Arguments& arguments, bool inch) {
  const std::string* text = arguments.text(q(400));
  return parse_tolerance(text == nullptr ? std::string_view{} : *text, inch);
}

CycleResult<void> probe_inclined(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const int turn = arguments.whole(1131);
  if (turn == 0) return nc_error(1042, "Q1131 must be -1 or +1");
  auto probing = TRY(ObjectProbing::begin(context));
  const auto start = TRY(probing.point(1100));
  if (start.limits != decltype(start.limits){})
    return nc_error(1011, "QS1100 to QS1102 are the start of the line: its tolerance is QS400");
  const auto limits = TRY(tolerance_of(arguments, context.host.is_inch()));
  const auto [sine, cosine] = machine::sine_cosine(arguments.number(1130));
  const auto plane = static_cast<std::size_t>(arguments.whole(1139));
  Vec3 along;
  Vec3 direction;
  along[plane % 3] = cosine;
  along[(plane + 1) % 3] = sine;
  direction[plane % 3] = -sine * turn;
  direction[(plane + 1) % 3] = cosine * turn;
  const auto at = [&](int distance) {
    const Vec3 nominal = start.nominal + along * arguments.number(distance);
    return ObjectPoint{.nominal = nominal, .measured = nominal};
  };
  auto found = TRY(touch_line(probing, at(1132), at(1133), direction, plane == 3));
  const ObjectPoint& first = found.points.front();
  found.sizes.push_back({.characteristic = "Distance from the nominal line",
                         .role = ValueRole::ShaftSize,
                         .measured = to_length(dot(first.nominal - first.measured, direction)),
                         .limits = limits,
                         .is_position = true});
  return probing.finish(found);
}

CycleResult<void> probe_plane(const CycleContext& context) {
  const auto direction = TRY(object_direction(context.arguments));
  auto probing = TRY(ObjectProbing::begin(context));
  ObjectFound found;
  std::vector<Touch> touches;
  std::vector<Vec3> nominal;
  for (const int first : {1100, 1103, 1106}) {
    const auto point = TRY(probing.point(first));
    found.points.push_back(point);
    nominal.push_back(point.nominal);
    touches.push_back(probing.towards(point.nominal, direction));
  }
  // Away from the material.
  const auto expected = fit_plane(nominal, -direction);
  if (!expected || std::abs(dot(expected->normal, direction)) <= tolerance::kCollinear)
    return nc_error(1081, "the three points lie on a straight line");
  const auto contacts = TRY(probing.touch({touches}));
  const auto plane = fit_plane(centres_in_space(contacts), -direction);
  if (!plane) return nc_error(1081, "the three touched points lie on a straight line");
  const Vec3 normal = plane->normal;
  const double ball = probing.motion().ball_radius();
  for (std::size_t i = 0; i < 3; ++i)
    found.points[i].touch(face_behind(contacts[i], direction, normal, ball), direction);
  found.turn = shortest_turn(expected->normal, normal);
  const WorkingPlane& working = probing.motion().plane();
  const auto spatial = [&](const Vec3& from) {
    return machine::spatial_angles(shortest_turn(working.to_input(from), working.to_input(normal)));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found.angles.push_back({kSpatial.at(axis).meaning, kSpatial.at(axis).q,
                            spatial({0, 0, 1})[axis], spatial(expected->normal)[axis]});
  }
  return probing.finish(found);
}

CycleResult<void> check_inclined(const Arguments& arguments) {
  TRY(check_dimensions(arguments));
  const auto tolerance = tolerance_of(arguments, false);
  return tolerance ? CycleResult<void>() : tolerance.error();
}

constinit const TouchProbeCycle kCycle1410 =
    object_cycle(1410, "PROBING ON EDGE", k1410, kLineResults, {1042, 1081, 1100}, probe_edge);
constinit const TouchProbeCycle kCycle1412 =
    object_cycle(1412, "INCLINED EDGE PROBING", k1412, kLineResults, {1004, 1042, 1081, 1100},
                 probe_inclined, check_inclined);
constinit const TouchProbeCycle kCycle1420 =
    object_cycle(1420, "PROBING IN PLANE", k1420, kPlaneResults, {1042, 1081}, probe_plane);

}  // namespace fitgauge::probing::cycle_1410_1420

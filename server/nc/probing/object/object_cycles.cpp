#include "nc/machine/tolerance.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/object/object_cycle.hpp"

namespace fitgauge::probing::object_cycles {

using namespace parameter;

constexpr std::array kEnd = list(kObject, transfer_position(1));
constexpr std::array kUndercut = list(length(1118, "Start further back from the face", 0), kEnd);
constexpr std::array kFace = list(kPoint1, kObjectDirection);
constexpr std::array kWidth = list(kPoint1, size(1113, "Width of the slot or ridge"),
                                   choice(1115, "Geometry: 0 slot, 1 ridge", 0, 1, 0),
                                   angle(1114, "Angle of rotation", 360, 0));
constexpr std::array k1400 = list(kFace, kEnd);
constexpr std::array k1404 = list(kWidth, kEnd);
constexpr std::array k1430 = list(kFace, kUndercut);
constexpr std::array k1434 = list(kWidth, kUndercut);
constexpr std::array k1493 =
    list(kObjectDirection, choice(1145, "Number of repetitions", 1, 99),
         ranged(1146, "Length", Unit::Length, {-99, 99}),
         choice(1149, "Effect: 0 next cycle, 1 until the program ends", 0, 1, 0));

constexpr auto kFaceResults = object_results<1>(std::array<CycleOutput, 0>{});
constexpr auto kWidthResults =
    object_results<1>(std::array{CycleOutput{968, "Width", Unit::Length}});

CycleResult<void> probe_face(const CycleContext& context) {
  const auto direction = object_direction(context);
  auto probing = TRY(ObjectProbing::begin(context));
  auto point = TRY(probing.point(1100));
  const auto contacts = TRY(probing.touch({{probing.towards(point.nominal, direction)}}));
  point.touch(contacts.front().surface, direction);
  return probing.finish({.points = {point}});
}

CycleResult<void> probe_width(const CycleContext& context) {
  auto probing = TRY(ObjectProbing::begin(context));
  auto point = TRY(probing.point(1100));
  const auto width = TRY(probing.size(1113));
  const bool ridge = context.whole(1115) == 1;
  const auto [sine, cosine] = machine::sine_cosine(context.number(1114));
  const Vec3 along{cosine, sine, 0};
  const Vec3 outwards = ridge ? -along : along;
  const double half = width.target.to_mm() / 2;
  const double offset = half + (ridge ? 1 : -1) * probing.start_distance();
  const Vec3 start = along * std::max(0.0, offset);
  const auto touched =
      probing.touch({{{.start = point.nominal + start, .direction = outwards},
                      {.start = point.nominal - start,
                       .direction = -outwards,
                       .transit = ridge ? Transit::ClearanceHeight : Transit::Straight}}});
  if (!touched) {
    const std::size_t axis = std::abs(cosine) > std::abs(sine) ? 0 : 1;
    auto place = width_place(ridge ? Side::Outside : Side::Inside, point.nominal, axis, 2 * half);
    place.other_side = ridge ? "Q1115 = 0" : "Q1115 = 1";
    return with_part(touched.error(), context, probing.motion().plane(), std::span(&place, 1));
  }
  const auto& contacts = *touched;
  const double first = dot(contacts.front().surface - point.nominal, along);
  const double second = dot(contacts.back().surface - point.nominal, along);
  point.measured = point.nominal + along * ((first + second) / 2);
  return probing.finish({.points = {point},
                         .sizes = {{.characteristic = "Width",
                                    .role = ridge ? ValueRole::ShaftSize : ValueRole::HoleSize,
                                    .nominal = width.target,
                                    .measured = to_length(first - second),
                                    .limits = width.limits,
                                    .result_q = 968,
                                    .deviation_q = 998}}});
}

CycleResult<void> extrude(const CycleContext& context) {
  const auto direction = object_direction(context);
  const Vec3 step = direction * (context.number(1146) / context.number(1145));
  context.host.memory().extrusion =
      Extrusion{step, static_cast<std::size_t>(context.whole(1145)), context.whole(1149) == 1};
  return {};
}

constexpr std::array kCentre = list(kPoint1, size(1116, "Diameter"));
constexpr std::array kTouched =
    list(choice(423, "Number of touches", 3, 8, 3), angle(325, "Starting angle", 360, 0),
         angle(1119, "Angular length", 360, 360), kObject);
constexpr std::array kCircleEnd = list(kTouched, transfer_position(1));
constexpr std::array k1401 =
    list(kCentre, choice(1115, "Geometry: 0 hole, 1 stud", 0, 1, 0), kCircleEnd);
constexpr std::array k1402 = list(kCentre, kCircleEnd);
constexpr std::array k1411 =
    list(kCentre, kPoint2, size(1117, "2nd diameter"),
         choice(1115, "Geometry: 0 holes, 1 studs, 2 hole and stud, 3 stud and hole", 0, 3, 0),
         kTouched, transfer_all(3, 2));

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
                      .centre = point.nominal,
                      .diameter = nominal.target.to_mm(),
                      .start_angle = arguments.number(325),
                      .step = sweep / (std::abs(sweep) == 360 ? points : points - 1),
                      .points = points,
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
  const int geometry = context.whole(1115);
  const std::array sides{geometry == 0 || geometry == 2 ? Side::Inside : Side::Outside,
                         geometry == 0 || geometry == 3 ? Side::Inside : Side::Outside};
  const int count = context.descriptor().number == 1411 ? 2 : 1;
  std::vector<ObjectCircle> circles;
  std::vector<std::vector<Touch>> objects;
  for (int i = 0; i < count; ++i) {
    const auto circle =
        TRY(circle_of(probing, sides.at(static_cast<std::size_t>(i)), 1100 + 3 * i, 1116 + i));
    circles.push_back(circle);
    objects.push_back(circle.touches);
  }
  const Vec3 nominal = circles.back().point.nominal - circles.front().point.nominal;
  if (count == 2 && nominal.x == 0 && nominal.y == 0)
    return nc_error(1081, "both centres are the same");
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
    found.form = circle_form(ball_centres(own), circle, context.number(325));
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
  const auto sphere = fit_sphere(ball_centres(contacts), {centre, half + ball});
  if (!sphere) return nc_error(1081, "no sphere passes near the touched points");
  object.point.measured = sphere->centre;
  return probing.finish(
      {.points = {object.point}, .sizes = {object.size(sphere->radius - ball, 966)}});
}

constexpr std::array kPoints = list(kPoint1, kPoint2);
constexpr std::array kLineEnd = list(kObjectDirection, kObject);
constexpr std::array k1410 = list(kPoints, kLineEnd, transfer_all(3, 2));
constexpr std::array k1412 = list(
    kPoint1, tolerance_text("Tolerance across the line, such as \"0.4-0.1\""),
    angle(1130, "Nominal angle of the line"),
    at_least(1, choice(1131, "Probing direction: the line turned by +1 or -1 right angle", -1, 1)),
    coordinates(1132, "1st distance along the line", "2nd distance along the line"),
    choice(1139, "Plane of the line: 1 YZ, 2 ZX, 3 XY", 1, 3, 3), kObject, transfer_all(1, 2));
constexpr std::array k1420 = list(
    kPoints, position(1106, "3rd point, main axis"), position(1107, "3rd point, secondary axis"),
    position(1108, "3rd point, probe axis"), kLineEnd, transfer_all(4, 1));

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
  if (norm(cross(nominal, direction)) <= tolerance::kCollinear * (1 + norm(nominal)))
    return nc_error(1081, "both points lie at the same place of the line");
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
  const auto direction = object_direction(context);
  auto probing = TRY(ObjectProbing::begin(context));
  const auto first = TRY(probing.point(1100));
  const auto second = TRY(probing.point(1103));
  const auto found = touch_line(probing, first, second, direction, direction.z == 0);
  return found ? probing.finish(*found) : found.error();
}

CycleResult<void> probe_inclined(const CycleContext& context) {
  const int turn = context.whole(1131);
  auto probing = TRY(ObjectProbing::begin(context));
  const auto start = TRY(probing.point(1100));
  if (start.limits != decltype(start.limits){})
    return nc_error(1011, "QS1100 to QS1102 are the start of the line: its tolerance is QS400");
  const auto limits = TRY(tolerance_of(context, context.host.block_is_inch()));
  const auto [sine, cosine] = machine::sine_cosine(context.number(1130));
  const auto plane = static_cast<std::size_t>(context.whole(1139));
  Vec3 along;
  Vec3 direction;
  along[plane % 3] = cosine;
  along[(plane + 1) % 3] = sine;
  direction[plane % 3] = -sine * turn;
  direction[(plane + 1) % 3] = cosine * turn;
  const auto at = [&](int distance) {
    const Vec3 nominal = start.nominal + along * context.number(distance);
    return ObjectPoint{.nominal = nominal, .measured = nominal};
  };
  auto found = TRY(touch_line(probing, at(1132), at(1133), direction, plane == 3));
  const ObjectPoint& first = found.points.front();
  found.sizes.push_back({.characteristic = "Distance from the nominal line",
                         .role = ValueRole::ShaftSize,
                         .is_face = true,
                         .measured = to_length(dot(first.nominal - first.measured, direction)),
                         .limits = limits});
  return probing.finish(found);
}

CycleResult<void> probe_plane(const CycleContext& context) {
  const auto direction = object_direction(context);
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
  const auto plane = fit_plane(ball_centres(contacts), -direction);
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
  TRY(tolerance_of(arguments, false));
  return {};
}

constexpr TouchProbeCycle kCycles[] = {
    object_cycle(1400, "POSITION PROBING", k1400, kFaceResults, {1042}, probe_face),
    object_cycle(1404, "PROBE SLOT/RIDGE", k1404, kWidthResults, {}, probe_width),
    object_cycle(1430, "PROBE POSITION OF UNDERCUT", k1430, kFaceResults, {1042}, probe_face),
    object_cycle(1434, "PROBE SLOT/RIDGE UNDERCUT", k1434, kWidthResults, {}, probe_width),
    cycle(1493, "EXTRUSION PROBING", CycleKind::Other, k1493, {}, {1042}, extrude,
          "Cycles 1400 to 1434 repeat each touch that often, evenly over the length, and "
          "measure the mean. Q970 to Q972 are the largest distances from it, of the first "
          "three touches, along their probing direction. No motion."),
    object_cycle(1401, "CIRCLE PROBING", k1401, kOneResults, {1081}, probe_circles),
    object_cycle(1402, "SPHERE PROBING", k1402, kOneResults, {1081}, probe_sphere),
    object_cycle(1411, "PROBING TWO CIRCLES", k1411, kTwoResults, {1081, 1100}, probe_circles),
    object_cycle(1410, "PROBING ON EDGE", k1410, kLineResults, {1042, 1081, 1100}, probe_edge),
    object_cycle(1412, "INCLINED EDGE PROBING", k1412, kLineResults, {1004, 1042, 1081, 1100},
                 probe_inclined, check_inclined),
    object_cycle(1420, "PROBING IN PLANE", k1420, kPlaneResults, {1042, 1081}, probe_plane)};

}  // namespace fitgauge::probing::object_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kObjectCycles = object_cycles::kCycles;

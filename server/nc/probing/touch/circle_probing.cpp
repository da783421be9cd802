#include "nc/probing/touch/probing_motion.hpp"

#include <ranges>

namespace fitgauge::probing {
namespace {

/// Between two faces around the corner of a stud, or through the centre of a pocket.
void go_around(Touch& next, const Touch& last, Side side, const Vec3& centre) {
  const bool last_along_main = last.direction.x != 0;
  next.waypoints = {side == Side::Inside ? centre
                    : last_along_main    ? Vec3{last.start.x, next.start.y, centre.z}
                                         : Vec3{next.start.x, last.start.y, centre.z}};
}

std::string described(const machine::PartFeature& part) {
  const auto [x, y] = part.length;
  if (part.diameter != 0)
    return fmt::format("{} of {} mm", part.is_boss ? "boss" : "bore", part.diameter);
  if (x == 0 || y == 0) return fmt::format("slot of {:.10g} mm", std::max(x, y));
  return fmt::format("{} of {:.10g} x {:.10g} mm", part.is_boss ? "boss" : "pocket", x, y);
}

/// Whether a cycle for such a part may be written for this one.
bool is_like(const machine::PartFeature& part, const PlannedPlace& place) {
  if (!place.length) return part.diameter != 0;
  if (part.diameter != 0) return false;
  const auto is_near = [&](std::size_t axis) {
    const double nominal = place.length->at(axis);
    return nominal == 0 || std::abs(part.length.at(axis) - nominal) <= nominal / 2;
  };
  return is_near(0) && is_near(1);
}

/// 421 and 422, 412 and 413, 408 and 409: inside and outside.
std::string for_other_side(int cycle, bool is_boss) {
  if (cycle == 405) return "cycle 405 probes in a bore";
  return fmt::format("cycle {}", is_boss ? cycle + 1 : cycle - 1);
}

}  // namespace

std::vector<Touch> circle_touches(const CirclePlan& plan) {
  const double outwards = plan.side == Side::Inside ? 1 : -1;
  const double pitch_radius = plan.diameter / 2 - outwards * plan.start_distance;
  const bool from_centre = pitch_radius <= 0;
  const Vec3& centre = plan.centre;
  const Transit between = from_centre          ? Transit::Straight
                          : plan.via_clearance ? Transit::ClearanceHeight
                          : plan.on_arc        ? Transit::Arc
                                               : Transit::Straight;
  std::vector<Touch> touches;
  for (int point = 0; point < plan.points; ++point) {
    const auto [sine, cosine] = machine::sine_cosine(plan.start_angle + point * plan.step);
    const Vec3 radial{cosine, sine, 0};
    touches.push_back({.start = from_centre ? centre : centre + radial * pitch_radius,
                       .direction = radial * outwards,
                       .transit = between,
                       .arc_centre = centre,
                       .arc_sweep = plan.step});
  }
  return touches;
}

std::vector<Vec3> ball_centres(std::span<const Contact> contacts) {
  std::vector<Vec3> centres;
  for (const Contact& contact : contacts) centres.push_back(contact.ball_centre);
  return centres;
}

CycleResult<Circle> circle_through(std::span<const Contact> contacts, Side side,
                                   double ball_radius) {
  auto circle = fit_circle(ball_centres(contacts));
  if (circle) circle->radius += side == Side::Inside ? ball_radius : -ball_radius;
  return circle;
}

Form circle_form(std::span<const Vec3> centres, const Circle& circle, double start_angle) {
  const std::size_t points = centres.size();
  Form form{
      .diameter_factor = circle.diameter_factor, .points = points, .start_angle_deg = start_angle};
  if (points == 3) {
    form.reason =
        "three points always lie on a circle: any form deviation is taken for centre and diameter";
    return form;
  }
  form.residual_mm = circle.residual;
  const auto distance = [&](const Vec3& point) {
    return std::hypot(point.x - circle.centre.x, point.y - circle.centre.y);
  };
  const auto [nearest, farthest] = std::ranges::minmax(centres | std::views::transform(distance));
  form.deviation = to_length(farthest - nearest);
  form.reason = points == 4 ? "four points show an oval in their residual only: three and five "
                              "lobes move the centre, four lobes change the diameter"
                            : std::to_string(points) +
                                  " points cannot show as many lobes: these change the diameter";
  return form;
}

CycleResult<ProbedCircle> probe_circle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, const Vec3& centre) {
  const auto touches = circle_touches({.side = side,
                                       .centre = centre,
                                       .diameter = context.number(262),
                                       .start_angle = context.number(325),
                                       .step = context.number(247),
                                       .points = static_cast<int>(context.number_or(423, 4)),
                                       .start_distance = motion.start_distance(),
                                       .via_clearance = context.whole(301) == 1,
                                       .on_arc = context.number_or(365, 1) == 1});
  const auto contacts =
      TRY(touch_part(context, motion, touches, {side, centre, context.number(262)}));
  const auto circle = TRY(circle_through(contacts, side, motion.ball_radius()));
  ProbedCircle probed{circle, circle_form(ball_centres(contacts), circle, context.number(325))};
  probed.form.touch_uncertainty_um = motion.touch_uncertainty_um();
  return probed;
}

CycleResult<std::vector<Vec3>> probe_hole_centres(const CycleContext& context,
                                                  ProbingMotion& motion,
                                                  std::span<const Vec3> nominal) {
  std::vector<Vec3> centres;
  for (const Vec3& point : nominal) {
    const auto touches = circle_touches({.centre = point});
    const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
    const auto circle = TRY(circle_through(contacts, Side::Inside, motion.ball_radius()));
    centres.push_back(circle.centre);
  }
  return centres;
}

CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion) {
  const double radius = context.number(262) / 2;
  std::vector<Vec3> nominal;
  for (const int angle : {291, 292, 293}) {
    const auto [sine, cosine] = machine::sine_cosine(context.number(angle));
    nominal.push_back(place_of(context, 273, 274, 261) + Vec3{cosine, sine, 0} * radius);
  }
  const auto holes = TRY(probe_hole_centres(context, motion, nominal));
  const auto circle = TRY(fit_circle(holes));
  return ProbedCircle{circle, circle_form(holes, circle, context.number(291))};
}

std::array<Touch, 2> width_touches(Side side, const Vec3& centre, std::size_t axis, double width,
                                   double start_distance) {
  const double outwards = side == Side::Inside ? 1 : -1;
  const double offset = std::max(0.0, width / 2 - outwards * start_distance);
  Vec3 up;
  up[axis] = 1;
  return {Touch{.start = centre + up * offset, .direction = up * outwards},
          Touch{.start = centre - up * offset, .direction = up * -outwards}};
}

CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, const Vec3& centre,
                                       const std::array<double, 2>& length) {
  const double distance = motion.start_distance();
  const auto main = width_touches(side, centre, 0, length[0], distance);
  const auto secondary = width_touches(side, centre, 1, length[1], distance);
  // Around the rectangle, so that no way leads across it.
  std::array touches{main[0], secondary[0], main[1], secondary[1]};
  for (std::size_t i = 1; i < touches.size(); ++i) {
    if (context.whole(301) == 1) {
      touches[i].transit = Transit::ClearanceHeight;
    } else {
      go_around(touches[i], touches[i - 1], side, centre);
    }
  }
  const auto contacts = TRY(touch_part(context, motion, touches, {side, centre, 0, length}));
  const double x1 = contacts[0].surface.x;
  const double x2 = contacts[2].surface.x;
  const double y1 = contacts[1].surface.y;
  const double y2 = contacts[3].surface.y;
  return Rectangle{{(x1 + x2) / 2, (y1 + y2) / 2, 0}, {x1 - x2, y1 - y2}};
}

CycleFault with_part(CycleFault fault, const CycleContext& context, const WorkingPlane& plane,
                     std::span<const PlannedPlace> places) {
  const bool is_touch =
      fault.kind == machine::FaultKind::NoContact || fault.kind == machine::FaultKind::Collision;
  constexpr double kFar = 0.5;
  if (!is_touch) return fault;
  for (const PlannedPlace& place : places) {
    const bool is_outside = place.side == Side::Outside;
    auto parts = context.machine.part_features(plane.to_input(place.centre));
    std::erase_if(parts, [&](const auto& part) { return !is_like(part, place); });
    if (parts.empty()) continue;
    const auto same = std::ranges::find(parts, is_outside, &machine::PartFeature::is_boss);
    const machine::PartFeature& here = same == parts.end() ? parts.front() : *same;
    const bool is_other = here.is_boss != is_outside;
    const bool has_size = place.diameter != 0 && here.diameter != 0;
    if (!is_other && (!has_size || std::abs(here.diameter - place.diameter) <= kFar)) continue;
    const std::string remedy = !is_other ? fmt::format("Q262 is {} mm", place.diameter)
                               : !place.other_side.empty()
                                   ? place.other_side
                                   : for_other_side(context.descriptor().number, here.is_boss);
    fault.text += fmt::format("; the setup has a {} here: {}", described(here), remedy);
    return fault;
  }
  return fault;
}

CycleResult<std::vector<Contact>> touch_part(const CycleContext& context, ProbingMotion& motion,
                                             std::span<const Touch> touches,
                                             const PlannedPlace& place) {
  auto contacts = motion.touch_all(touches, context.number(260));
  if (contacts) return contacts;
  return with_part(contacts.error(), context, motion.plane(), std::span(&place, 1));
}

PlannedPlace width_place(Side side, const Vec3& centre, std::size_t axis, double width) {
  std::array<double, 2> length{};
  length.at(axis) = width;
  return {side, centre, 0, length};
}

}  // namespace fitgauge::probing

#include "nc/probing/touch/circle_probing.hpp"

#include <ranges>

#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing {

std::vector<Touch> circle_touches(const CirclePlan& plan) {
  const double outwards = plan.side == Side::Inside ? 1 : -1;
  const double pitch_radius = plan.diameter / 2 - outwards * plan.start_distance;
  const bool from_centre = pitch_radius <= 0;
  const Vec3 centre{plan.centre.x, plan.centre.y, plan.height};
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

std::vector<Point2> ball_centres(std::span<const Contact> contacts) {
  std::vector<Point2> centres;
  for (const Contact& contact : contacts) {
    centres.push_back({contact.ball_centre.x, contact.ball_centre.y});
  }
  return centres;
}

std::vector<Vec3> centres_in_space(std::span<const Contact> contacts) {
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

Form circle_form(std::span<const Point2> centres, const Circle& circle, double start_angle) {
  const std::size_t points = centres.size();
  Form form{
      .diameter_factor = circle.diameter_factor, .points = points, .start_angle_deg = start_angle};
  if (points == 3) {
    form.reason =
        "three points always lie on a circle: any form deviation is taken for centre and diameter";
    return form;
  }
  form.residual_mm = circle.residual;
  const auto distance = [&](const Point2& point) {
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
                                       Side side, Point2 centre) {
  const double step = context.number(247);
  if (step == 0) return nc_error(1066);
  if (std::abs(step) < 5) return nc_error(1067);
  const auto touches = circle_touches({.side = side,
                                       .centre = centre,
                                       .diameter = context.number(262),
                                       .start_angle = context.number(325),
                                       .step = step,
                                       .points = static_cast<int>(context.number_or(423, 4)),
                                       .height = context.number(261),
                                       .start_distance = motion.start_distance(),
                                       .via_clearance = context.whole(301) == 1,
                                       .on_arc = context.number_or(365, 1) == 1});
  const PlannedPlace place{side, {centre.x, centre.y, context.number(261)}, context.number(262)};
  const auto contacts = TRY(touch_part(context, motion, touches, place));
  const auto circle = TRY(circle_through(contacts, side, motion.ball_radius()));
  ProbedCircle probed{circle, circle_form(ball_centres(contacts), circle, context.number(325))};
  probed.form.touch_uncertainty_um = motion.touch_uncertainty_um();
  return probed;
}

CycleResult<std::vector<Point2>> probe_hole_centres(const CycleContext& context,
                                                    ProbingMotion& motion,
                                                    std::span<const Point2> nominal) {
  std::vector<Point2> centres;
  for (const Point2& point : nominal) {
    const auto touches = circle_touches({.centre = point, .height = context.number(261)});
    const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
    const auto circle = TRY(circle_through(contacts, Side::Inside, motion.ball_radius()));
    centres.push_back(circle.centre);
  }
  return centres;
}

CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion) {
  const double radius = context.number(262) / 2;
  std::vector<Point2> nominal;
  for (const int angle : {291, 292, 293}) {
    const auto [sine, cosine] = machine::sine_cosine(context.number(angle));
    nominal.push_back({context.number(273) + radius * cosine, context.number(274) + radius * sine});
  }
  const auto holes = TRY(probe_hole_centres(context, motion, nominal));
  const auto circle = TRY(fit_circle(holes));
  return ProbedCircle{circle, circle_form(holes, circle, context.number(291))};
}

}  // namespace fitgauge::probing

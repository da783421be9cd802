#include "nc/probing/touch/hole_pattern.hpp"

namespace fitgauge::probing {

CycleResult<std::vector<Point2>> probe_hole_centres(ProbingMotion& motion,
                                                    std::span<const Point2> nominal, double height,
                                                    double clearance_height) {
  std::vector<Point2> centres;
  for (const Point2& point : nominal) {
    const auto touches = circle_touches({.centre = point, .height = height});
    const auto contacts = motion.touch_all(touches, clearance_height);
    if (!contacts) return contacts.error();
    const auto circle = circle_through(*contacts, Side::Inside, motion.ball_radius());
    if (!circle) return circle.error();
    centres.push_back(circle->centre);
  }
  return centres;
}

CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const double radius = arguments.number(262) / 2;
  std::vector<Point2> nominal;
  for (const int angle : {291, 292, 293}) {
    const auto [sine, cosine] = machine::sine_cosine(arguments.number(angle));
    nominal.push_back(
        {arguments.number(273) + radius * cosine, arguments.number(274) + radius * sine});
  }
  const auto holes =
      probe_hole_centres(motion, nominal, arguments.number(261), arguments.number(260));
  if (!holes) return holes.error();
  const auto circle = fit_circle(*holes);
  if (!circle) return circle.error();
  return ProbedCircle{*circle, circle_form(holes->size(), *circle)};
}

}  // namespace fitgauge::probing

#include "probing/hole_pattern.hpp"

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

std::vector<Point2> bolt_circle_holes(const Arguments& arguments, Point2 centre) {
  std::vector<Point2> holes;
  const double radius = arguments.number(262) / 2;
  for (const int angle : {291, 292, 293}) {
    const auto [sine, cosine] = machine::sine_cosine(arguments.number(angle));
    holes.push_back({centre.x + radius * cosine, centre.y + radius * sine});
  }
  return holes;
}

}  // namespace fitgauge::probing

#include "nc/probing/preset/preset_cycle.hpp"

#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch/single_touch.hpp"

namespace fitgauge::probing {

DatumPoint plane_datum(const Arguments& arguments, Point2 point) {
  return {.point = {point.x, point.y, arguments.number(261)},
          .axes = {true, true, false},
          .datum = {arguments.number(331), arguments.number(332), 0}};
}

CycleResult<void> finish_preset(const CycleContext& context, ProbingMotion& motion,
                                const DatumPoint& found, std::optional<double> basic_rotation) {
  const Arguments& arguments = context.arguments;
  std::vector<DatumPoint> points{found};
  if (arguments.whole(381) == 1) {
    const Vec3 nominal{arguments.number(382), arguments.number(383), arguments.number(384)};
    const auto surface =
        touch_down(motion, nominal, arguments.number_or(320, 0), arguments.number(260));
    if (!surface) return surface.error();
    points.push_back(
        {.point = *surface, .axes = {false, false, true}, .datum = {0, 0, arguments.number(333)}});
  }
  return transfer_datum(context, motion.plane(), points, basic_rotation);
}

CycleResult<void> set_datum_of_axis(const CycleContext& context, const WorkingPlane& plane,
                                    const Vec3& surface, std::size_t axis) {
  set_length(context.host, 160, surface[axis]);
  DatumPoint found{.point = surface};
  found.axes[axis] = true;
  found.datum[axis] = context.arguments.number(333);
  return transfer_datum(context, plane, std::array{found});
}

}  // namespace fitgauge::probing

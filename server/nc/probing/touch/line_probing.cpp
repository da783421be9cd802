#include "nc/probing/touch/line_probing.hpp"

#include <cmath>

#include "nc/probing/touch/single_touch.hpp"

namespace fitgauge::probing {

double ProbedLine::angle_deg() const {
  const Vec3 along = direction();
  if (axis == 2) return machine::degrees(std::atan(along.z / along[across]));
  double angle = machine::degrees(std::atan2(along.y, along.x));
  const double lowest = axis == 1 ? -90 : 0;
  if (angle <= lowest) angle += 180;
  if (angle > lowest + 180) angle -= 180;
  return angle;
}

CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const auto direction = probing_direction(arguments);
  if (!direction) return direction.error();
  const double height = arguments.number(261);
  const std::array nominal{Vec3{arguments.number(263), arguments.number(264), height},
                           Vec3{arguments.number(265), arguments.number(266), height}};
  ProbedLine line;
  line.axis = static_cast<std::size_t>(arguments.whole(272) - 1);
  line.across = line.axis == 0 || (line.axis == 2 && nominal[0].x == nominal[1].x) ? 1 : 0;
  if (nominal[0][line.across] == nominal[1][line.across]) {
    return nc_error(1081, "both points lie at the same place of the line");
  }
  Vec3 along;
  along[line.axis] = *direction;
  const Vec3 back = along * motion.start_distance(arguments.number(320));
  const Transit between = arguments.whole(301) == 1 ? Transit::ClearanceHeight : Transit::Straight;
  const std::array touches{
      Touch{.start = nominal[0] - back, .direction = along},
      Touch{.start = nominal[1] - back, .direction = along, .transit = between}};
  const auto contacts = motion.touch_all(touches, arguments.number(260));
  if (!contacts) return contacts.error();
  line.first = contacts->front().ball_centre;
  line.second = contacts->back().ball_centre;
  for (std::size_t k = 0; k < 2; ++k) {
    line.coordinates[k] = {nominal[k][line.axis], (*contacts)[k].surface[line.axis]};
  }
  return line;
}

}  // namespace fitgauge::probing

#include "nc/probing/touch/single_touch.hpp"

#include <array>

namespace fitgauge::probing {
namespace {

CycleResult<Vec3> touch(ProbingMotion& motion, const Vec3& nominal, const Vec3& direction,
                        double q320, double clearance_height) {
  const std::array touches{
      Touch{.start = nominal - direction * motion.start_distance(q320), .direction = direction}};
  const auto contacts = motion.touch_all(touches, clearance_height);
  if (!contacts) return contacts.error();
  return contacts->front().surface;
}

}  // namespace

CycleResult<int> probing_direction(const Arguments& arguments) {
  const int direction = arguments.whole(267);
  if (direction == 0) return nc_error(1042, "Q267 must be -1 or +1");
  return direction;
}

CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context,
                                                ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const auto direction = probing_direction(arguments);
  if (!direction) return direction.error();
  TouchedCoordinate touched{
      .axis = static_cast<std::size_t>(arguments.whole(272) - 1),
      .nominal = {arguments.number(263), arguments.number(264), arguments.number(261)},
      .surface = {}};
  Vec3 along;
  along[touched.axis] = *direction;
  const auto surface =
      touch(motion, touched.nominal, along, arguments.number(320), arguments.number(260));
  if (!surface) return surface.error();
  touched.surface = *surface;
  return touched;
}

CycleResult<Vec3> touch_down(ProbingMotion& motion, const Vec3& nominal, double q320,
                             double clearance_height) {
  return touch(motion, nominal, {0, 0, -1}, q320, clearance_height);
}

}  // namespace fitgauge::probing

#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::cycle_431 {

using machine::Matrix3;
using namespace parameter;

constexpr std::array kParameters{coordinate(263, "1st point, main axis"),
                                 coordinate(264, "1st point, secondary axis"),
                                 coordinate(294, "1st point, probe axis"),
                                 coordinate(265, "2nd point, main axis"),
                                 coordinate(266, "2nd point, secondary axis"),
                                 coordinate(295, "2nd point, probe axis"),
                                 coordinate(296, "3rd point, main axis"),
                                 coordinate(297, "3rd point, secondary axis"),
                                 coordinate(298, "3rd point, probe axis"),
                                 kSetUpClearance,
                                 kClearanceHeight,
                                 kMeasuringLog};

constexpr std::array<CycleOutput, 8> kResults{{{158, "Projection angle A", Unit::Angle},
                                               {159, "Projection angle B", Unit::Angle},
                                               {170, "Spatial angle A", Unit::Angle},
                                               {171, "Spatial angle B", Unit::Angle},
                                               {172, "Spatial angle C", Unit::Angle},
                                               {173, "1st point, probe axis", Unit::Length},
                                               {174, "2nd point, probe axis", Unit::Length},
                                               {175, "3rd point, probe axis", Unit::Length}}};

struct TiltedAxes {
  Vec3 main;
  Vec3 secondary;
  Vec3 normal;
};

/// Points 1 and 2 define the direction of the main axis, point 3 that of the secondary axis.
CycleResult<TiltedAxes> axes_through(const std::vector<Contact>& contacts) {
  const Vec3 along = contacts[1].ball_centre - contacts[0].ball_centre;
  const Vec3 side = contacts[2].ball_centre - contacts[0].ball_centre;
  const auto plane = fit_plane(centres_in_space(contacts), cross(along, side));
  if (!plane) return nc_error(1081, "the three points lie on a straight line");
  TiltedAxes axes{.main = unit(along), .secondary = {}, .normal = plane->normal};
  axes.secondary = cross(axes.normal, axes.main);
  return axes;
}

/// The spatial angles of PLANE SPATIAL that tilt the working plane into the measured one.
Vec3 spatial_angles_of(const TiltedAxes& axes, const WorkingPlane& plane) {
  Matrix3 columns;
  columns.rows[index(plane.main)] = plane.to_input(axes.main);
  columns.rows[index(plane.secondary)] = plane.to_input(axes.secondary);
  columns.rows[index(plane.probe)] = plane.to_input(axes.normal);
  return machine::spatial_angles(columns.transposed());
}

CycleResult<void> measure(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const Vec3 down{0, 0, -1};
  const Vec3 back = down * motion.start_distance(arguments.number(320));
  std::vector<Touch> touches;
  for (const auto& [x, y, z] :
       {std::array{263, 264, 294}, std::array{265, 266, 295}, std::array{296, 297, 298}}) {
    const Vec3 nominal{arguments.number(x), arguments.number(y), arguments.number(z)};
    touches.push_back(
        {.start = nominal - back, .direction = down, .transit = Transit::ClearanceHeight});
  }
  const auto contacts = TRY(motion.touch_all(touches, arguments.number(260)));
  const auto axes = TRY(axes_through(contacts));

  MeasuringLog log(arguments.descriptor(), context.host);
  log.section("Actual values");
  const auto publish_angle = [&](const CycleOutput& result, double angle) {
    context.host.set_q(result.q, to_angle(angle), Unit::Angle);
    log.angle(result.meaning, angle);
  };
  const Vec3& n = axes.normal;
  const Vec3 spatial = spatial_angles_of(axes, motion.plane());
  publish_angle(kResults[0], machine::degrees(std::atan2(-n.y, n.z)));
  publish_angle(kResults[1], machine::degrees(std::atan2(n.x, n.z)));
  for (std::size_t i = 0; i < 3; ++i) publish_angle(kResults[2 + i], spatial[i]);
  MeasuringRecord record{.cycle = arguments.descriptor().number};
  for (std::size_t i = 0; i < 3; ++i) {
    // The ball touches next to its lowest point: the plane is below its centre by radius / cosine.
    const Vec3& centre = contacts[i].ball_centre;
    const Length height = to_length(centre.z - motion.ball_radius() / std::abs(n.z));
    context.host.set_q(kResults[5 + i].q, height.to_mm(), Unit::Length);
    log.length(kResults[5 + i].meaning, height);
    record.sizes.push_back({.characteristic = kResults[5 + i].meaning,
                            .is_position = true,
                            .nominal = to_length(touches[i].start.z + back.z),
                            .measured = height});
  }
  TRY(deliver_log(context, std::move(log)));
  context.host.record(record);
  return {};
}

constinit const TouchProbeCycle kCycle431 =
    cycle(431, "MEASURE PLANE", CycleKind::Measuring, kParameters, kResults,
          errors::kMeasuring | ErrorSet{1081}, after<begin_measurement, measure>,
          "All parameters; the measured coordinates are those of the plane at the points.");

}  // namespace fitgauge::probing::cycle_431

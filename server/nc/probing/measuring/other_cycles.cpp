#include "nc/probing/cycles.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::other_cycles {

using machine::Matrix3;
using namespace parameter;

constexpr std::array k420Parameters = list(line(kMeasuringAxis), kMeasuringLog);

constexpr std::array k420Results = results(150, Unit::Angle, "Measured angle");

CycleResult<void> measure_angle(const CycleContext& context, ProbingMotion& motion) {
  const auto edge = TRY(probe_line(context, motion));
  const double angle = to_angle(edge.angle_deg());
  context.host.set_q(150, angle, Unit::Angle);
  MeasuringLog log(context.descriptor(), context.host);
  log.section("Actual values");
  log.number("Measured angle", angle);
  log.section("Further results");
  log.length("Measuring height", to_length(context.number(261)));
  TRY(deliver_log(context, std::move(log)));
  MeasuringRecord record{.cycle = context.descriptor().number};
  constexpr std::array<std::string_view, 2> kNames{"1st point", "2nd point"};
  for (std::size_t k = 0; k < 2; ++k) {
    record.sizes.push_back({.characteristic = kNames.at(k),
                            .role = ValueRole::Position,
                            .nominal = to_length(edge.coordinates.at(k).nominal),
                            .measured = to_length(edge.coordinates.at(k).measured)});
  }
  context.host.record(record);
  return {};
}

constexpr std::array k431Parameters =
    list(coordinates(263, "1st point, main axis", "1st point, secondary axis"),
         coordinate(294, "1st point, probe axis"),
         coordinates(265, "2nd point, main axis", "2nd point, secondary axis"),
         coordinates(295, "2nd point, probe axis", "3rd point, main axis",
                     "3rd point, secondary axis", "3rd point, probe axis"),
         kSetUpClearance, kClearanceHeight, kMeasuringLog);

constexpr std::array k431Results =
    list(results(158, Unit::Angle, "Projection angle A", "Projection angle B"),
         results(170, Unit::Angle, "Spatial angle A", "Spatial angle B", "Spatial angle C"),
         results(173, Unit::Length, "1st point, probe axis", "2nd point, probe axis",
                 "3rd point, probe axis"));

/// The axes of the measured plane as rows: main, secondary, normal. Points 1 and 2 define the
/// direction of the main axis, point 3 that of the secondary axis.
CycleResult<Matrix3> axes_through(const std::vector<Contact>& contacts) {
  const Vec3 along = contacts[1].ball_centre - contacts[0].ball_centre;
  const Vec3 side = contacts[2].ball_centre - contacts[0].ball_centre;
  const auto plane = fit_plane(ball_centres(contacts), cross(along, side));
  if (!plane) return nc_error(1081, "the three points lie on a straight line");
  return Matrix3{{unit(along), cross(plane->normal, unit(along)), plane->normal}};
}

/// The spatial angles of PLANE SPATIAL that tilt the working plane into the measured one.
Vec3 spatial_angles_of(const Matrix3& axes, const WorkingPlane& plane) {
  Matrix3 columns;
  columns.rows[index(plane.main)] = plane.to_input(axes.rows[0]);
  columns.rows[index(plane.secondary)] = plane.to_input(axes.rows[1]);
  columns.rows[index(plane.probe)] = plane.to_input(axes.rows[2]);
  return machine::spatial_angles(columns.transposed());
}

CycleResult<void> measure_plane(const CycleContext& context, ProbingMotion& motion) {
  const Vec3 down{0, 0, -1};
  const Vec3 back = down * motion.start_distance();
  std::vector<Touch> touches;
  for (const auto& [x, y, z] :
       {std::array{263, 264, 294}, std::array{265, 266, 295}, std::array{296, 297, 298}}) {
    const Vec3 nominal = place_of(context, x, y, z);
    touches.push_back(
        {.start = nominal - back, .direction = down, .transit = Transit::ClearanceHeight});
  }
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  const auto axes = TRY(axes_through(contacts));

  MeasuringLog log(context.descriptor(), context.host);
  log.section("Actual values");
  const auto publish_angle = [&](const CycleOutput& result, double angle) {
    context.host.set_q(result.q, to_angle(angle), Unit::Angle);
    log.number(result.meaning, angle);
  };
  const Vec3& n = axes.rows[2];
  const Vec3 spatial = spatial_angles_of(axes, motion.plane());
  publish_angle(k431Results[0], machine::degrees(std::atan2(-n.y, n.z)));
  publish_angle(k431Results[1], machine::degrees(std::atan2(n.x, n.z)));
  for (std::size_t i = 0; i < 3; ++i) publish_angle(k431Results[2 + i], spatial[i]);
  MeasuringRecord record{.cycle = context.descriptor().number};
  for (std::size_t i = 0; i < 3; ++i) {
    // The ball touches next to its lowest point: the plane is below its centre by radius / cosine.
    const Vec3& centre = contacts[i].ball_centre;
    const Length height = to_length(centre.z - motion.ball_radius() / std::abs(n.z));
    context.host.set_q(k431Results[5 + i].q, height.to_mm(), Unit::Length);
    log.length(k431Results[5 + i].meaning, height);
    record.sizes.push_back({.characteristic = k431Results[5 + i].meaning,
                            .role = ValueRole::Position,
                            .nominal = to_length(touches[i].start.z + back.z),
                            .measured = height});
  }
  TRY(deliver_log(context, std::move(log)));
  context.host.record(record);
  return {};
}

constexpr std::array k441Parameters =
    list(ranged(396, "Positioning feed, 0: FMAX of the probe", Unit::Feed, {0, kLongest}, 0),
         choice(397, "Position with the rapid of the machine: 0 no, 1 yes", 0, 1, 0),
         choice(399, "Angle tracking: 0 no, 1 yes", 0, 1, 1),
         choice(400, "Automatic interruption: 0 no, 1 yes", 0, 1, 1),
         newer(choice(371, "Reaction of the touch point", 0, 1, 0)));

CycleResult<void> set_fast_probing(const CycleContext& context) {
  context.host.memory().fast_probing = {.positioning_feed = context.number(396),
                                        .machine_rapid = context.whole(397) == 1,
                                        .interrupts = context.whole(400) == 1};
  return {};
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(420, "MEASURE ANGLE", CycleKind::Measuring, k420Parameters, k420Results,
          errors::kMeasuring | ErrorSet{1042, 1081}, after<begin_measurement, measure_angle>,
          "All parameters. The angle is that of the line to the main axis, with Q272 = 3 "
          "to the axis along which the points differ."),
    cycle(431, "MEASURE PLANE", CycleKind::Measuring, k431Parameters, k431Results,
          errors::kMeasuring | ErrorSet{1081}, after<begin_measurement, measure_plane>,
          "All parameters; the measured coordinates are those of the plane at the points."),
    cycle(441, "FAST PROBING", CycleKind::Other, k441Parameters, {}, {}, set_fast_probing,
          "Positioning feed, rapid and interruption hold for the cycles after it until the "
          "program ends.",
          "Angle tracking (Q399), which the simulated probe needs none of, and Q371: "
          "the values are checked and change nothing.")};

}  // namespace fitgauge::probing::other_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kOtherCycles = other_cycles::kCycles;

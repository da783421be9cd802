#include "nc/probing/kinematics/sphere.hpp"

#include "nc/probing/touch/fits.hpp"

namespace fitgauge::probing {
namespace {

using machine::AxisWords;
using machine::CoordinateSystem;

}  // namespace

CycleResult<SphereProbe> SphereProbe::begin(const CycleContext& context) {
  TRY(ProbingMotion::begin(context));
  return SphereProbe(context);
}

SphereProbe::SphereProbe(const CycleContext& context)
    : machine_(context.machine),
      host_(context.host),
      probe_(*context.state().probe_system()),
      sphere_radius_(context.number(407)),
      clearance_(probe_.data.set_up + context.number(320)),
      feed_(context.number(253)),
      first_angle_(context.number(380)),
      touches_(context.whole(423)) {}

machine::Feed SphereProbe::feed() const {
  const bool machine_rapid = probe_.data.prepositioning == machine::PrePositioning::MachineRapid;
  return machine::Feed::rapid(machine_rapid ? feed_ : std::min(feed_, probe_.data.rapid));
}

Vec3 SphereProbe::tool_direction() const {
  return machine_.state().tool_direction(CoordinateSystem::Machine);
}

Vec3 SphereProbe::ball() const { return machine_.state().ball_centre(CoordinateSystem::Machine); }

CycleResult<void> SphereProbe::move_tip(const Vec3& tip) {
  return lift_move(machine_.move({AxisWords::linear(tip), feed(), CoordinateSystem::Machine}));
}

CycleResult<void> SphereProbe::move_ball(const Vec3& centre) {
  return move_tip(centre - tool_direction() * probe_.radius);
}

CycleResult<void> SphereProbe::go_over(const Vec3& sphere, double distance) {
  const Vec3 up = tool_direction();
  const double height = dot(ball() - sphere, up);
  if (height < distance) TRY(move_ball(ball() + up * (distance - height)));
  TRY(move_ball(sphere + up * std::max(height, distance)));
  return move_ball(sphere + up * distance);
}

CycleResult<Vec3> SphereProbe::touch(const Vec3& direction) {
  const auto contact = machine_.probe({.direction = direction,
                                       .distance = probe_.data.distance,
                                       .feed = probe_.data.feed,
                                       .system = CoordinateSystem::Machine,
                                       .retract = std::nullopt,
                                       .retract_feed = feed()});
  if (!contact) return from_machine(contact.error());
  publish_touch(machine_.state(), host_, *contact);
  return contact->tip_machine + tool_direction() * probe_.radius;
}

CycleResult<Vec3> SphereProbe::find() {
  const Vec3 up = tool_direction();
  const auto touched = TRY(touch(-up));
  return touched - up * (sphere_radius_ + probe_.radius);
}

/// Direction from the main axis of the workpiece system; with an inclined head, from the part of
/// that axis across the tool.
Vec3 SphereProbe::around(double angle_deg) const {
  const machine::MachineState& state = machine_.state();
  const WorkingPlane plane = WorkingPlane::across(state.tool_axis());
  const Vec3 up = tool_direction();
  constexpr double kAlong = 0.1;
  Vec3 first;
  for (const machine::Axis axis : {plane.main, plane.secondary}) {
    const Vec3 along =
        state.frames.direction_to_machine(unit_vector(axis), CoordinateSystem::Workpiece);
    first = along - up * dot(along, up);
    if (norm(first) > kAlong) break;
  }
  return machine::Matrix3::rotation(up, angle_deg) * unit(first);
}

CycleResult<Vec3> SphereProbe::measure(const Vec3& sphere) {
  constexpr double kTurn = 360;
  const double distance = start_distance();
  TRY(go_over(sphere, distance));
  const Vec3 up = tool_direction();
  const auto pole = TRY(touch(-up));
  std::vector<Vec3> centres{pole};
  for (int k = 0; k < touches_; ++k) {
    const Vec3 outward = around(first_angle_ + k * kTurn / touches_);
    const Vec3 beside = sphere + outward * distance;
    const Vec3 above = beside + up * distance;
    TRY(move_ball(above));
    TRY(move_ball(beside));
    const auto touched = TRY(touch(-outward));
    centres.push_back(touched);
    TRY(move_ball(above));
  }
  TRY(move_ball(sphere + up * distance));

  const auto fitted = fit_sphere(centres, {sphere, sphere_radius_ + probe_.radius});
  if (!fitted) return nc_error(1072, "the touched points lie on no sphere");
  const double radius = fitted->radius - probe_.radius;
  const double largest = machine_.state().kinematics_options.max_ball_deviation;
  if (std::abs(radius - sphere_radius_) > largest) {
    return nc_error(1072,
                    fmt::format("the calibration sphere has a radius of {:.4f} mm, not {} mm; "
                                "max_calibration_ball_deviation_mm is {} mm",
                                radius, sphere_radius_, largest));
  }
  return fitted->centre;
}

CycleResult<void> lift_move(const machine::MachineResult<void>& moved) {
  if (moved) return {};
  if (moved.error().kind == machine::FaultKind::AxisLimit) {
    return nc_error(1101, moved.error().text);
  }
  return from_machine(moved.error());
}

}  // namespace fitgauge::probing

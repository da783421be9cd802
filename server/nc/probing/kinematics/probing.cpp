#include "nc/probing/kinematics/measurement.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::AxisWords;
using machine::CoordinateSystem;
using machine::Feed;
using machine::MachineState;

constexpr std::array kRotary{Axis::A, Axis::B, Axis::C};

Feed feed_of(double rate) { return std::isinf(rate) ? Feed::rapid() : Feed::at(rate); }

CycleResult<void> set_tcpm(machine::Machine& machine, bool on) {
  machine::Modes modes = machine.state().modes;
  modes.tcpm = on;
  return machine.set_modes(modes);
}

CycleResult<void> reset_tilting(machine::Machine& machine) {
  machine::Frames frames = machine.state().frames;
  frames.set_plane(std::nullopt);
  TRY(machine.set_frames(frames));
  return set_tcpm(machine, false);
}

CycleResult<void> check_retraction(const Arguments& arguments, const MachineState& state) {
  const double height = arguments.number(408);
  if (height > 0) {
    if (height > arguments.number(407)) return {};
    return nc_error(1082, "the retraction height Q408 lies inside the calibration sphere");
  }
  if (!state.kinematics_options.tcpm) {
    return nc_error(1082, "Q408 = 0 needs the option of TCPM; without it give a retraction height");
  }
  for (const Axis axis : kRotary) {
    const auto& range = state.ranges[index(axis)];
    if (range && range->hirth_grid_deg > 0)
      return nc_error(1082, "Q408 = 0 is not allowed with Hirth axes");
  }
  return {};
}

/// The words of the axes that turn.
AxisWords turning_words(const MachineState& state, const Vec3& rotary) {
  AxisWords words;
  for (const Axis axis : kRotary) {
    const double target = rotary[index(axis) - 3];
    if (state.ranges[index(axis)] && state.nose[axis] != target) words[axis] = target;
  }
  return words;
}

}  // namespace

CycleResult<KinematicsProbing> KinematicsProbing::begin(const CycleContext& context) {
  TRY(ProbingMotion::begin(context));
  TRY(check_retraction(context, context.state()));
  TRY(reset_tilting(context.machine));
  return KinematicsProbing(context);
}

machine::Feed KinematicsProbing::feed() const {
  const bool machine_rapid = probe_.data.prepositioning == machine::PrePositioning::MachineRapid;
  const double rate = context_.number(253);
  return Feed::rapid(machine_rapid ? rate : std::min(rate, probe_.data.rapid));
}

Vec3 KinematicsProbing::tool_direction() const {
  return state().tool_direction(CoordinateSystem::Machine);
}

Vec3 KinematicsProbing::expected(const Vec3& rotary) const {
  return state().kinematics.table(rotary).point(sphere_);
}

/// Direction from the main axis of the workpiece system; with an inclined head, from the part of
/// that axis across the tool.
Vec3 KinematicsProbing::around(double angle_deg) const {
  const machine::MachineState& state = this->state();
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

CycleResult<void> KinematicsProbing::move(const AxisWords& words, const Feed& feed) {
  const auto moved = context_.machine.move({words, feed, CoordinateSystem::Machine});
  if (!moved && moved.error().kind == machine::FaultKind::AxisLimit)
    return nc_error(1101, moved.error().text);
  return moved;
}

CycleResult<void> KinematicsProbing::move_tip(const Vec3& tip) {
  return move(AxisWords::linear(tip), feed());
}

CycleResult<void> KinematicsProbing::move_ball(const Vec3& centre) {
  return move_tip(centre - tool_direction() * probe_.radius);
}

/// Moves the ball over a sphere: up, if need be, across, down.
CycleResult<void> KinematicsProbing::go_over(const Vec3& sphere) {
  const Vec3 up = tool_direction();
  const double distance = start_distance();
  const Vec3 ball = state().ball_centre(CoordinateSystem::Machine);
  const double height = dot(ball - sphere, up);
  if (height < distance) TRY(move_ball(ball + up * (distance - height)));
  TRY(move_ball(sphere + up * std::max(height, distance)));
  return move_ball(sphere + up * distance);
}

CycleResult<Vec3> KinematicsProbing::touch(const Vec3& direction) {
  const auto contact = TRY(context_.machine.probe({.direction = direction,
                                                   .distance = probe_.data.distance,
                                                   .feed = probe_.data.feed,
                                                   .system = CoordinateSystem::Machine,
                                                   .retract_feed = feed()}));
  publish_touch(state(), context_.host, contact);
  return contact.tip_machine + tool_direction() * probe_.radius;
}

/// Measures a sphere whose centre is expected at `sphere`.
CycleResult<Vec3> KinematicsProbing::measure_sphere(const Vec3& sphere) {
  constexpr double kTurn = 360;
  const double distance = start_distance();
  const double wanted = context_.number(407);
  const int touches = context_.whole(423);
  TRY(go_over(sphere));
  const Vec3 up = tool_direction();
  const auto pole = TRY(touch(-up));
  std::vector<Vec3> centres{pole};
  for (int k = 0; k < touches; ++k) {
    const Vec3 outward = around(context_.number(380) + k * kTurn / touches);
    const Vec3 beside = sphere + outward * distance;
    const Vec3 above = beside + up * distance;
    TRY(move_ball(above));
    TRY(move_ball(beside));
    const auto touched = TRY(touch(-outward));
    centres.push_back(touched);
    TRY(move_ball(above));
  }
  TRY(move_ball(sphere + up * distance));
  const auto fitted = fit_sphere(centres, {sphere, wanted + probe_.radius});
  if (!fitted) return nc_error(1072, "the touched points lie on no sphere");
  const double radius = fitted->radius - probe_.radius;
  const double largest = state().kinematics_options.max_ball_deviation;
  if (std::abs(radius - wanted) > largest) {
    return nc_error(1072,
                    "the calibration sphere has a radius of {:.4f} mm, not {} mm; "
                    "max_calibration_ball_deviation_mm is {} mm",
                    radius, wanted, largest);
  }
  return fitted->centre;
}

CycleResult<void> KinematicsProbing::find() {
  const Vec3 up = tool_direction();
  const auto touched = TRY(touch(-up));
  const Vec3 found = touched - up * (context_.number(407) + probe_.radius);
  sphere_ = state().kinematics.table(state().nose.rotary).inverse().point(found);
  const auto measured = TRY(measure_here());
  sphere_ = on_table(measured, state().kinematics, tool());
  return {};
}

CycleResult<SpherePose> KinematicsProbing::measure(const Vec3& rotary) {
  TRY(turn(rotary));
  return measure_here();
}

CycleResult<SpherePose> KinematicsProbing::measure_here() {
  const Vec3 rotary = state().nose.rotary;
  const auto centre = TRY(measure_sphere(expected(rotary)));
  const auto [axis, length] = tool();
  return SpherePose{rotary, centre - state().kinematics.tool_vector(rotary, axis, length)};
}

CycleResult<void> KinematicsProbing::turn(const Vec3& rotary) {
  if (state().nose.rotary == rotary) return {};
  if (follows()) return circle(rotary);
  TRY(retract());
  publish_targets(rotary);
  return move(turning_words(state(), rotary), feed_of(context_.number(253)));
}

/// Sets Q120 to Q122, the targets for an M function of the builder (mStrobeRotAxPos).
void KinematicsProbing::publish_targets(const Vec3& rotary) {
  for (std::size_t letter = 0; letter < 3; ++letter) {
    if (!state().kinematics_options.strobed[letter]) continue;
    context_.host.set_q(static_cast<std::uint16_t>(120 + letter), rotary[letter], Unit::Angle);
  }
}

CycleResult<void> KinematicsProbing::retract() {
  if (follows()) return go_over(expected(state().nose.rotary));
  const double retraction = context_.number(408);
  const Vec3 up = state().frames.direction_to_machine(unit_vector(state().tool_axis()),
                                                      CoordinateSystem::Workpiece);
  const Vec3 tip = state().position(CoordinateSystem::Machine).linear;
  const double height = dot(tip - sphere_, up);
  if (height < retraction) TRY(move_tip(tip + up * (retraction - height)));
  TRY(move_tip(sphere_ + up * std::max(height, retraction)));
  return move_tip(sphere_ + up * retraction);
}

/// In steps: between them the tip runs straight on the table, so the circle is a polygon around
/// the distance to be kept.
CycleResult<void> KinematicsProbing::circle(const Vec3& rotary) {
  constexpr double kStepDeg = 30;
  const Vec3 from = state().nose.rotary;
  const Vec3 way = rotary - from;
  const double angle = std::abs(way.x) + std::abs(way.y) + std::abs(way.z);
  // The ball stays clear of the sphere on either side of the tip.
  const double clear =
      context_.number(407) + 2 * probe_.radius + (probe_.data.set_up + context_.number(320));
  const double distance = clear / machine::sine_cosine(kStepDeg / 2).cosine;
  const auto tip_at = [&](const Vec3& position) {
    return expected(position) +
           state().kinematics.tool_direction(position, state().tool_axis()) * distance;
  };
  TRY(go_over(expected(from)));
  TRY(move_tip(tip_at(from)));
  TRY(set_tcpm(context_.machine, true));
  const int steps = std::max(1, static_cast<int>(std::ceil(angle / kStepDeg)));
  for (int step = 1; step <= steps; ++step) {
    const Vec3 next = step == steps ? rotary : from + way * (static_cast<double>(step) / steps);
    publish_targets(next);
    AxisWords words = turning_words(state(), next);
    const Vec3 tip = tip_at(next);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) words[axis] = tip[index(axis)];
    TRY(move(words, feed_of(context_.number(253))));
  }
  return set_tcpm(context_.machine, false);
}

}  // namespace fitgauge::probing

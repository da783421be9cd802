#include "nc/probing/kinematics/probing.hpp"

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
  return lift(machine.set_modes(modes));
}

CycleResult<void> reset_tilting(machine::Machine& machine) {
  machine::Frames frames = machine.state().frames;
  frames.set_plane(std::nullopt);
  TRY(lift(machine.set_frames(frames)));
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
    if (range && range->hirth_grid_deg > 0) {
      return nc_error(1082, "Q408 = 0 is not allowed with Hirth axes");
    }
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
  const auto probe = TRY(SphereProbe::begin(context));
  TRY(check_retraction(context, context.state()));
  const bool follows = context.number(408) == 0;
  TRY(reset_tilting(context.machine));
  return KinematicsProbing(context, probe, follows);
}

KinematicsProbing::KinematicsProbing(const CycleContext& context, const SphereProbe& probe,
                                     bool follows)
    : machine_(context.machine),
      host_(context.host),
      probe_(probe),
      retraction_(context.number(408)),
      turning_feed_(feed_of(context.number(253))),
      follows_(follows),
      sphere_(machine_.state().frames.preset().origin) {}

Vec3 KinematicsProbing::expected(const Vec3& rotary) const {
  return state().kinematics.table(rotary).point(sphere_);
}

CycleResult<void> KinematicsProbing::find() {
  const auto found = TRY(probe_.find());
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
  const auto centre = TRY(probe_.measure(expected(rotary)));
  const auto [axis, length] = tool();
  const SpherePose pose{rotary, centre - state().kinematics.tool_vector(rotary, axis, length)};
  return pose;
}

CycleResult<void> KinematicsProbing::turn(const Vec3& rotary) {
  if (state().nose.rotary == rotary) return {};
  if (follows_) return circle(rotary);
  TRY(retract());
  return turn_axes(rotary);
}

/// Sets Q120 to Q122, the targets for an M function of the builder (mStrobeRotAxPos).
void KinematicsProbing::publish_targets(const Vec3& rotary) {
  for (std::size_t letter = 0; letter < 3; ++letter) {
    if (!state().kinematics_options.strobed[letter]) continue;
    host_.set_q(static_cast<std::uint16_t>(120 + letter), rotary[letter], Unit::Angle);
  }
}

CycleResult<void> KinematicsProbing::turn_axes(const Vec3& rotary) {
  publish_targets(rotary);
  return lift_move(
      machine_.move({turning_words(state(), rotary), turning_feed_, CoordinateSystem::Machine}));
}

CycleResult<void> KinematicsProbing::retract() {
  if (follows_) return probe_.go_over(expected(state().nose.rotary), probe_.start_distance());
  const Vec3 up = state().frames.direction_to_machine(unit_vector(state().tool_axis()),
                                                      CoordinateSystem::Workpiece);
  const Vec3 tip = machine_.position(CoordinateSystem::Machine).linear;
  const double height = dot(tip - sphere_, up);
  if (height < retraction_) TRY(probe_.move_tip(tip + up * (retraction_ - height)));
  TRY(probe_.move_tip(sphere_ + up * std::max(height, retraction_)));
  return probe_.move_tip(sphere_ + up * retraction_);
}

/// In steps: between them the tip runs straight on the table, so the circle is a polygon around
/// the distance to be kept.
CycleResult<void> KinematicsProbing::circle(const Vec3& rotary) {
  constexpr double kStepDeg = 30;
  const Vec3 from = state().nose.rotary;
  const Vec3 way = rotary - from;
  const double angle = std::abs(way.x) + std::abs(way.y) + std::abs(way.z);
  const double distance = probe_.circling_distance() / machine::sine_cosine(kStepDeg / 2).cosine;
  const auto tip_at = [&](const Vec3& position) {
    return expected(position) +
           state().kinematics.tool_direction(position, state().tool_axis()) * distance;
  };
  TRY(probe_.go_over(expected(from), probe_.start_distance()));
  TRY(probe_.move_tip(tip_at(from)));
  TRY(set_tcpm(machine_, true));
  const int steps = std::max(1, static_cast<int>(std::ceil(angle / kStepDeg)));
  for (int step = 1; step <= steps; ++step) {
    const Vec3 next = step == steps ? rotary : from + way * (static_cast<double>(step) / steps);
    publish_targets(next);
    AxisWords words = turning_words(state(), next);
    const Vec3 tip = tip_at(next);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) words[axis] = tip[index(axis)];
    TRY(lift_move(machine_.move({words, turning_feed_, CoordinateSystem::Machine})));
  }
  return set_tcpm(machine_, false);
}

}  // namespace fitgauge::probing

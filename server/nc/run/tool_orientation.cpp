#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

/// The angle equivalent to `angle` that is in the range and nearest to `from`.
std::optional<double> nearest_turn(double angle, double from, const machine::AxisRange& range) {
  const double whole = angle + 360 * std::round((from - angle) / 360);
  std::optional<double> nearest;
  for (const double turned : {whole, whole - 360, whole + 360}) {
    if (turned < range.min - tolerance::kSameAngle || turned > range.max + tolerance::kSameAngle)
      continue;
    if (!nearest || std::abs(turned - from) < std::abs(*nearest - from)) nearest = turned;
  }
  return nearest;
}

NcResult<void> stand_along(Channel& channel, const Vec3& direction, MotionWords& words) {
  const MachineState& state = channel.state();
  const Position position = channel.contour.position(channel.machine());
  const Vec3 from = state.frames.rotary_to_machine(position.rotary, CoordinateSystem::Input);
  Frames on_table = state.frames;
  on_table.set_table({});
  const Vec3 normal = unit(on_table.direction_to_machine(direction));
  const auto rotary = rotary_along(state, normal, from);
  if (!rotary) {
    return nc_error(1013,
                    "no position of the rotary axes points the tool along {:.4f} {:.4f} {:.4f}",
                    direction.x, direction.y, direction.z);
  }
  const Vec3 shown = state.frames.rotary_from_machine(*rotary, CoordinateSystem::Input);
  for (std::size_t letter = 0; letter < 3; ++letter) words.axes[letter + 3].reset();
  for (const RotaryAxis& axis : state.kinematics.axes())
    words.axes[index(axis.axis)] = {shown[index(axis.axis) - 3], false};
  return {};
}

NcResult<void> turn_by_angles(Channel& channel, SpatialAngles& angles, MotionWords& words) {
  bool turns = false;
  for (std::size_t letter = 0; letter < 3; ++letter) {
    const auto& word = words.axes[letter + 3];
    if (!word) continue;
    turns = true;
    angles[letter] = word->value + (word->incremental ? angles[letter].value_or(0) : 0);
  }
  if (!turns) return {};
  Vec3 spatial;
  for (std::size_t letter = 0; letter < 3; ++letter) {
    if (!angles[letter]) {
      return nc_error(
          "AXIS SPAT: the first block that turns the tool gives A, B and C; "
          "{} is missing",
          "ABC"[letter]);
    }
    spatial[letter] = *angles[letter];
  }
  const Axis tool_axis = channel.state().tool_axis();
  return stand_along(channel, Matrix3::spatial(spatial) * unit_vector(tool_axis), words);
}

}  // namespace

std::optional<Vec3> in_range(const MachineState& state, Vec3 rotary, const Vec3& from) {
  for (const RotaryAxis& axis : state.kinematics.axes()) {
    const std::size_t letter = index(axis.axis) - 3;
    const auto& range = state.ranges[index(axis.axis)];
    const auto turned = range ? nearest_turn(rotary[letter], from[letter], *range) : std::nullopt;
    if (!turned) return std::nullopt;
    rotary[letter] = *turned;
  }
  return rotary;
}

std::optional<Vec3> rotary_along(const MachineState& state, const Vec3& normal, const Vec3& from) {
  std::optional<Vec3> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& solution : state.kinematics.orientations(normal, from, state.tool_axis())) {
    const auto rotary = in_range(state, solution, from);
    if (!rotary) continue;
    const Vec3 turn = *rotary - from;
    const double way = std::abs(turn.x) + std::abs(turn.y) + std::abs(turn.z);
    if (way >= least) continue;
    least = way;
    nearest = rotary;
  }
  return nearest;
}

NcResult<std::optional<Vec3>> vector_of(Channel& channel, const klartext::Motion& motion,
                                        Letter first) {
  std::optional<Vec3> vector;
  if (motion.path != klartext::Path::Ln) return vector;
  for (const Word& word : channel.program().view(motion.words)) {
    const int axis = static_cast<int>(word.letter) - static_cast<int>(first);
    if (axis < 0 || axis > 2) continue;
    const auto value = TRY(number(channel, word.value));
    if (!vector) vector.emplace();
    (*vector)[static_cast<std::size_t>(axis)] = value;
  }
  if (vector && norm(*vector) < tolerance::kSameDirection) {
    return nc_error(first == Letter::Tx ? "LN: the tool vector TX TY TZ has no length"
                                        : "LN: the normal NX NY NZ has no length");
  }
  return vector;
}

NcResult<void> orient_tool(Channel& channel, const klartext::Motion& motion, MotionWords& words) {
  if (words.has_m(91) || words.has_m(92)) return {};
  const bool follows = channel.state().modes.tcpm;
  auto vector = vector_of(channel, motion, Letter::Tx);
  if (!vector) return vector.error();
  if (!*vector && follows && !channel.state().kinematics.axes().empty()) {
    vector = vector_of(channel, motion, Letter::Nx);  // square to the surface
    if (!vector) return vector.error();
  }
  if (*vector) {
    if (follows) return stand_along(channel, **vector, words);
    return channel.note(
        "LN: the tool vector TX TY TZ turns the tool with M128 or FUNCTION TCPM only");
  }
  return follows && channel.spatial_angles ? turn_by_angles(channel, *channel.spatial_angles, words)
                                           : NcResult<void>();
}

}  // namespace fitgauge::interpreter

#include "nc/run/statements.hpp"

#include "nc/klartext/block_reader.hpp"
#include "nc/program/diagnose.hpp"

namespace fitgauge::interpreter {
namespace {

/// The feed of FU (mm per revolution) and FZ (mm per tooth).
double feed_of_revolutions(const Channel& channel, double per_revolution) {
  return per_revolution * channel.state().modes.spindle_rpm;
}

int teeth(const Channel& channel) {
  const Tool* tool = channel.state().active_tool();
  return tool == nullptr ? 0 : tool->teeth;
}

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

NcResult<void> turn_by_angles(Channel& channel, MotionWords& words) {
  auto& angles = *channel.spatial_angles;
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

NcResult<void> read_coordinate(Channel& channel, const Word& word, double unit,
                               std::optional<Coordinate>& target) {
  if (is_absent(word.value)) return {};
  const auto value = TRY(coordinate(channel, word.value));
  if (!value)
    return channel.note("{} is left out: its parameter is undefined", spelling(word.letter));
  target = Coordinate{*value * unit, word.incremental};
  return {};
}

NcResult<void> read_number(Channel& channel, const Word& word, double unit,
                           std::optional<double>& target) {
  const auto value = TRY(number(channel, word.value));
  target = value * unit;
  return {};
}

NcResult<void> read_m(Channel& channel, const Word& word, std::vector<MCall>& calls) {
  const auto value = TRY(whole(channel, word.value));
  const int called = value;
  if (const MFunction* known = m_function(called)) {
    if (known->role == MRole::Refuses) return nc_error(m_function_hint(called));
    if (known->role == MRole::Notes) TRY(channel.note("M{}: {}", called, known->text));
    calls.push_back({.number = called});
    return {};
  }
  const BuilderAction* action = channel.options.builder.m_function(called);
  if (action == nullptr) return nc_error(m_function_hint(called));
  if (action->program) calls.push_back({.number = called, .program = &*action->program});
  return {};
}

/// The words after an M function. Words of M functions that only leave a note have no effect.
NcResult<void> read_argument(Channel& channel, const Word& word, std::vector<MCall>& calls) {
  if (!calls.empty() && calls.back().number == 128) {
    return channel.note(
        "M128 F: the compensating moves of the linear axes take no feed of their own");
  }
  if (calls.empty() || calls.back().number != 140) return {};
  MCall& retraction = calls.back();
  if (word.letter == Letter::MbMax) {
    retraction.to_limit = true;
    return {};
  }
  if (word.letter == Letter::Mb)
    return read_number(channel, word, channel.length_unit(), retraction.length);
  retraction.feed = TRY(read_feed(channel, word));
  return {};
}

NcResult<void> read_word(Channel& channel, const Word& word, MotionWords& out) {
  const double unit = channel.length_unit();
  if (word.argument) return read_argument(channel, word, out.m);
  if (is_axis(word.letter)) {
    const auto axis = TRY(machine_axis(word.letter));
    return read_coordinate(channel, word, is_rotary(axis) ? 1 : unit, out.axes[index(axis)]);
  }
  switch (word.letter) {
    case Letter::Pr: return read_coordinate(channel, word, unit, out.pr);
    case Letter::Pa: return read_coordinate(channel, word, 1, out.pa);
    case Letter::R: return read_number(channel, word, unit, out.r);
    case Letter::Len: return read_number(channel, word, unit, out.len);
    case Letter::Cca: return read_number(channel, word, 1, out.cca);
    case Letter::Chamfer: return read_number(channel, word, unit, out.chamfer);
    case Letter::M: return read_m(channel, word, out.m);
    default: break;  // feeds, and normal vectors of LN
  }
  if (klartext::kFeeds.contains(word.letter)) out.feed = TRY(read_feed(channel, word));
  return {};
}

}  // namespace

NcResult<Feed> read_feed(Channel& channel, const Word& word) {
  if (word.letter == Letter::Ft || word.letter == Letter::FMaxT)
    return nc_error("FT and FMAXT, the time of a block, are not available: give the feed F");
  if (word.letter == Letter::FMax) return Feed::rapid();
  if (word.letter == Letter::FAuto) return Feed::at(channel.contour.tool_feed);
  const auto value = TRY(number(channel, word.value));
  const double unit = channel.length_unit();
  if (word.letter == Letter::Fu) return Feed::at(feed_of_revolutions(channel, value * unit));
  if (word.letter == Letter::Fz)
    return Feed::at(feed_of_revolutions(channel, value * unit * teeth(channel)));
  if (channel.contour.feed_per_revolution)
    return Feed::at(feed_of_revolutions(channel, value * unit));
  // In INCH programs F counts tenths of an inch a minute.
  return Feed::at(channel.linked().is_inch() ? value * unit / 10 : value);
}

bool MotionWords::names_axes() const {
  return pr || pa || std::ranges::any_of(axes, [](const auto& axis) { return axis.has_value(); });
}

bool MotionWords::has_m(int number) const {
  return std::ranges::count(m, number, &MCall::number) > 0;
}

NcResult<Axis> machine_axis(Letter letter) {
  if (letter <= Letter::C) return static_cast<Axis>(letter);
  return make_fault(machine::FaultKind::AxisMissing, klartext::spelling(letter));
}

NcResult<MotionWords> read_words(Channel& channel, Slice<Word> words) {
  MotionWords out;
  const Word* feed = nullptr;
  for (const Word& word : channel.program().view(words)) {
    TRY(read_word(channel, word, out));
    if (word.letter == Letter::F && !word.argument) feed = &word;
  }
  // M136 and M137 apply to the F of their block.
  const bool per_revolution = channel.contour.feed_per_revolution;
  for (const MCall& call : out.m) {
    if (call.number == 136 || call.number == 137)
      channel.contour.feed_per_revolution = call.number == 136;
  }
  if (feed != nullptr && channel.contour.feed_per_revolution != per_revolution)
    TRY(read_word(channel, *feed, out));
  return out;
}

NcResult<Feed> use_feed(Channel& channel, const std::optional<Feed>& written) {
  Modes modes = channel.state().modes;
  if (!written) return Feed::at(modes.feed_mm_min);
  if (!written->is_rapid && written->rate != modes.feed_mm_min) {
    modes.feed_mm_min = written->rate;
    TRY(channel.machine().set_modes(modes));
  }
  return *written;
}

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
  auto vector = TRY(vector_of(channel, motion, Letter::Tx));
  if (!vector && follows && !channel.state().kinematics.axes().empty())
    vector = TRY(vector_of(channel, motion, Letter::Nx));  // square to the surface
  if (vector) {
    if (follows) return stand_along(channel, *vector, words);
    return channel.note(
        "LN: the tool vector TX TY TZ turns the tool with M128 or FUNCTION TCPM only");
  }
  return follows && channel.spatial_angles ? turn_by_angles(channel, words) : NcResult<void>();
}

}  // namespace fitgauge::interpreter

#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using Words = std::span<const Word>;

const Word* find(Words words, Letter letter) {
  const auto it = std::ranges::find(words, letter, &Word::letter);
  return it == words.end() ? nullptr : &*it;
}

/// The number of a word, or `otherwise` if it is absent.
NcResult<double> value(Channel& channel, Words words, Letter letter, double otherwise) {
  const Word* word = find(words, letter);
  if (word == nullptr || is_absent(word->value)) return otherwise;
  return number(channel, word->value);
}

NcResult<void> datum_shift(Channel& channel, Words words) {
  if (const Word* row = find(words, Letter::Row))
    return shift_datum_to_row(channel, TRY(whole(channel, row->value)));
  return shift_datum(channel, TRY(read_axis_words(channel, words)));
}

/// Tolerance of the path, which a simulated path does not have.
NcResult<void> tolerance(Channel& channel, Words words) {
  const auto width = TRY(value(channel, words, Letter::T, 0));
  if (width < 0) return nc_error(1004, "T of cycle 32 is {}", width);
  return {};
}

/// The spindle turns to the angle, which nothing here depends on.
NcResult<void> orientation(Channel& channel, Words words) {
  const auto angle = TRY(value(channel, words, Letter::Value, 0));
  if (std::abs(angle) > 360) return nc_error(1013, "cycle 13: {} degrees", angle);
  return {};
}

NcResult<void> dwell(Channel& channel, Words words) {
  return channel.machine().dwell(TRY(value(channel, words, Letter::Value, 0)));
}

NcResult<void> rotation(Channel& channel, Words words) {
  const auto angle = TRY(value(channel, words, Letter::Rot, 0));
  const Word* word = find(words, Letter::Rot);
  return rotate(channel, {angle, word != nullptr && word->incremental});
}

NcResult<void> scaling(Channel& channel, Words words) {
  const auto factor = TRY(value(channel, words, Letter::Scl, 1));
  return scale(channel, {{factor, factor, factor}, {}});
}

NcResult<void> axis_scaling(Channel& channel, Words words) {
  machine::Scaling scaling;
  constexpr std::array kFactors{Letter::X, Letter::Y, Letter::Z};
  constexpr std::array kCentres{Letter::Ccx, Letter::Ccy, Letter::Ccz};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto factor = TRY(value(channel, words, kFactors[axis], 1));
    const auto centre = TRY(value(channel, words, kCentres[axis], 0));
    scaling.factor[axis] = factor;
    scaling.centre[axis] = centre * channel.length_unit();
  }
  return scale(channel, scaling);
}

NcResult<void> working_plane_cycle(Channel& channel, Words words) {
  const auto axes = TRY(read_axis_words(channel, words));
  Vec3 angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& word = axes[i + 3];
    if (word && word->incremental)
      return nc_error("cycle 19 takes no I: write the angles themselves");
    if (word) angles[i] = word->value;
  }
  if (find(words, Letter::F) != nullptr || find(words, Letter::Value) != nullptr)
    TRY(channel.note("cycle 19: F and ABST have no effect, because the program turns the axes"));
  if (angles == Vec3{}) return reset_tilt(channel, {});
  return tilt(channel, Matrix3::spatial(angles), {});
}

NcResult<void> program_call(Channel& channel, Words words) {
  const Word* path = find(words, Letter::Program);
  if (path == nullptr) return nc_error(1017, "CYCL DEF 12 needs a program");
  const auto written = TRY(text(channel, path->value));
  channel.active_cycle.definition = TRY(channel.resolve_program(written));
  channel.active_cycle.number = 12;
  return {};
}

}  // namespace

NcResult<std::array<bool, 3>> mirrored_axes(std::span<const Word> words) {
  std::array<bool, 3> axes{};
  for (const Word& word : words) {
    if (word.letter > Letter::Z)
      return nc_error("only X, Y and Z are mirrored here, not {}", klartext::spelling(word.letter));
    axes[static_cast<std::size_t>(word.letter)] = true;
  }
  return axes;
}

NcResult<AxisCoordinates> read_axis_words(Channel& channel, std::span<const Word> words) {
  AxisCoordinates axes;
  for (const Word& word : words) {
    if (!is_axis(word.letter) || is_absent(word.value)) continue;
    const auto axis = TRY(machine_axis(word.letter));
    const auto value = TRY(number(channel, word.value));
    const double unit = is_rotary(axis) ? 1 : channel.length_unit();
    axes[index(axis)] = Coordinate{value * unit, word.incremental};
  }
  return axes;
}

NcResult<void> execute_transformation(Channel& channel, int cycle, Words words) {
  switch (cycle) {
    case 7: return datum_shift(channel, words);
    case 8: return mirror(channel, TRY(mirrored_axes(words)));
    case 9: return dwell(channel, words);
    case 10: return rotation(channel, words);
    case 11: return scaling(channel, words);
    case 12: return program_call(channel, words);
    case 19: return working_plane_cycle(channel, words);
    case 26: return axis_scaling(channel, words);
    case 13: return orientation(channel, words);
    default: return tolerance(channel, words);
  }
}

}  // namespace fitgauge::interpreter

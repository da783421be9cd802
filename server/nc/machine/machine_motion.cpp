#include "nc/machine/machine.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

/// The machining time stops counting here: with a feed near 0 it would become infinite.
constexpr double kLongestSeconds = 1e12;

MachineResult<void> check_finite(const AxisWords& words) {
  for (const Axis axis : kAllAxes) {
    if (words[axis] && !std::isfinite(*words[axis]))
      return make_fault(FaultKind::ValueInvalid, "{} is not a number", name(axis));
  }
  return {};
}

}  // namespace

MachineResult<void> Machine::move_straight(const LinearMove& move) {
  TRY(check_feed(move.feed));
  TRY(check_finite(move.target));
  const auto rotary = TRY(target_rotary(move));
  const bool turns = rotary != state_.nose.rotary;
  std::optional<Frames> turned;
  if (turns && is_following()) {
    turned = state_.frames;
    turned->set_table(state_.kinematics.table(rotary));
  }
  const auto nose = TRY(target_nose(move, turned ? *turned : state_.frames, rotary));
  TRY(check_range(nose));
  if (!turns || !state_.modes.tcpm) return travel(straight_path(state_.nose, nose), move.feed);
  const Path path = following_path(nose);
  TRY(check_way(path, path.turn));
  return travel(path, move.feed);
}

MachineResult<Vec3> Machine::target_rotary(const LinearMove& move) const {
  Vec3 rotary = state_.nose.rotary;
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const auto& word = move.target[axis];
    if (!word) continue;
    const auto& range = state_.ranges[index(axis)];
    if (!range) return make_fault(FaultKind::AxisMissing, name(axis));
    const std::size_t letter = index(axis) - 3;
    Vec3 programmed;
    programmed[letter] = *word;
    rotary[letter] = state_.frames.rotary_to_machine(programmed, move.system)[letter];
    const double grid = range->hirth_grid_deg;
    if (grid > 0 && std::abs(std::remainder(rotary[letter], grid)) > tolerance::kOnTooth) {
      return make_fault(FaultKind::HirthGrid, "{}{:+.4f} with a grid of {} degrees", name(axis),
                        rotary[letter], grid);
    }
  }
  return rotary;
}

/// Returns the end position of the nose with the rotary axes at `rotary`; `frames` are valid there.
MachineResult<Position> Machine::target_nose(const LinearMove& move, const Frames& frames,
                                             const Vec3& rotary) const {
  bool has_linear = false;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    has_linear = has_linear || move.target[axis];
    if (move.target[axis] && !state_.ranges[index(axis)])
      return make_fault(FaultKind::AxisMissing, name(axis));
  }
  Vec3 point = state_.nose.linear;
  const auto take_words = [&] {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      point[index(axis)] = move.target[axis].value_or(point[index(axis)]);
  };
  if (move.system == CoordinateSystem::Reference || (!has_linear && !state_.modes.tcpm)) {
    take_words();
    return Position{point, rotary};
  }
  const Vec3 tool = state_.kinematics.tool_vector(rotary, state_.tool_axis(), state_.tool_length());
  point = state_.modes.tcpm ? state_.position(move.system).linear
                            : frames.from_machine(state_.nose.linear + tool, move.system);
  take_words();
  return Position{frames.to_machine(point, move.system) - tool, rotary};
}

/// With TCPM the tip runs straight on the table while the rotary axes turn.
Path Machine::following_path(const Position& end) const {
  const Kinematics kinematics = state_.kinematics;
  const Axis axis = state_.tool_axis();
  const double length = state_.tool_length();
  const Position start = state_.nose;
  const auto tip_on_table = [&](const Position& nose) {
    const Vec3 tip = nose.linear + kinematics.tool_vector(nose.rotary, axis, length);
    return kinematics.table(nose.rotary).inverse().point(tip);
  };
  const Vec3 from = tip_on_table(start);
  const Vec3 way = tip_on_table(end) - from;
  const Vec3 turn = end.rotary - start.rotary;

  Path path = straight_path(start, end);
  path.nose = [=](double part) {
    const Vec3 rotary = start.rotary + turn * part;
    return Position{kinematics.table(rotary).point(from + way * part) -
                        kinematics.tool_vector(rotary, axis, length),
                    rotary};
  };
  path.length = norm(way);
  double lever = std::abs(length) + norm(from) + norm(way);
  for (const RotaryAxis& known : kinematics.axes()) lever += 2 * norm(known.centre);
  path.nose_speed =
      path.length + radians(std::abs(turn.x) + std::abs(turn.y) + std::abs(turn.z)) * lever;
  return path;
}

MachineResult<void> Machine::move_around(const ArcMove& arc) {
  TRY(check_feed(arc.feed));
  constexpr double kLongestSweepDeg = 1e6;
  TRY(require(is_finite(arc.end) && is_finite(arc.centre) && !is_rotary(arc.normal) &&
                  std::abs(arc.sweep_deg) <= kLongestSweepDeg,
              "an arc needs finite points, a sweep and a plane"));
  const std::size_t up = index(arc.normal);
  const Vec3 normal = unit_vector(arc.normal);
  const Transform input = state_.frames.input();
  const Vec3 start = state_.position().linear;
  const Vec3 rotary = state_.nose.rotary;
  const Vec3 length = state_.nose.linear - input.point(start);
  Vec3 from = start - arc.centre;
  Vec3 to = arc.end - arc.centre;
  const double rise = to[up] - from[up];
  from[up] = 0;
  to[up] = 0;
  const Matrix3 back = Matrix3::rotation(normal, -arc.sweep_deg);
  // The end's direction turned back differs from the start's by the rounding of the program only:
  // spread over the arc, it meets both ends.
  const Vec3 difference = back * to - from;

  Path path;
  path.start = state_.nose;
  path.nose = [=](double part) {
    Vec3 point =
        arc.centre + Matrix3::rotation(normal, arc.sweep_deg * part) * (from + difference * part);
    point[up] = start[up] + rise * part;
    return Position{input.point(point) + length, rotary};
  };
  path.end = path.nose(1);
  path.is_straight = false;
  const Vec3 scale = state_.frames.scaling().factor;
  const double stretch = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
  const double sweep = std::abs(arc.sweep_deg);
  const double radius = std::max(norm(from), norm(to));
  path.length = stretch * std::hypot(radians(sweep) * (norm(from) + norm(to)) / 2, rise);
  path.nose_speed =
      stretch * (radians(sweep) * (radius + norm(difference)) + norm(difference) + std::abs(rise));
  TRY(check_way(path, sweep));
  return travel(path, arc.feed);
}

/// Checks a way that is not straight: first its end, then every 0.1 degrees, unless all places as
/// near to the start are in range.
MachineResult<void> Machine::check_way(const Path& path, double turn_deg) {
  TRY(check_range(path.end));
  bool is_clear = true;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const auto& range = state_.ranges[index(axis)];
    const double at = path.start[axis];
    is_clear =
        is_clear && range && at - path.nose_speed > range->min && at + path.nose_speed < range->max;
  }
  if (is_clear) return {};
  constexpr double kStepDeg = 0.1;
  const auto steps = static_cast<int>(turn_deg / kStepDeg) + 1;
  for (int step = 1; step < steps; ++step) {
    constexpr int kBetweenLooks = 256;
    if (step % kBetweenLooks == 0 && allowance_.is_spent())
      return make_fault(FaultKind::Interrupted);
    TRY(check_range(path.nose(static_cast<double>(step) / steps)));
  }
  return {};
}

MachineResult<void> Machine::check_range(const Position& nose) const {
  for (const Axis axis : kAllAxes) {
    const auto& range = state_.ranges[index(axis)];
    if (!range) continue;
    const double at = nose[axis];
    if (at >= range->min - tolerance::kSamePoint && at <= range->max + tolerance::kSamePoint)
      continue;
    return make_fault(FaultKind::AxisLimit, "{}{:+.4f} is outside {} to {}", name(axis), at,
                      range->min, range->max);
  }
  return {};
}

void Machine::stand_at(const Position& nose) {
  const bool has_turned = nose.rotary != state_.nose.rotary;
  state_.nose = nose;
  if (has_turned && is_following()) state_.frames.set_table(state_.kinematics.table(nose.rotary));
}

MachineResult<void> Machine::check_feed(const Feed& feed) {
  const bool is_usable = feed.rate > 0 && (feed.is_rapid || std::isfinite(feed.rate));
  if (is_usable) return {};
  return make_fault(FaultKind::FeedMissing, "a feed of {} mm/min", feed.rate);
}

double Machine::seconds_of(double way, const Feed& feed) const {
  constexpr double kSecondsPerMinute = 60;
  return std::min(way / feed.rate_on(state_.rapid_mm_min) * kSecondsPerMinute, kLongestSeconds);
}

void Machine::spend(double seconds) {
  state_.elapsed_s = std::min(state_.elapsed_s + seconds, kLongestSeconds);
}

Motion Machine::motion(const Feed& feed, bool is_retract) {
  const Tool* row = state_.active_tool();
  return {.feed = Feed{feed.is_rapid, feed.rate_on(state_.rapid_mm_min)},
          .tool = {.number = state_.tool.number,
                   .is_probe = row != nullptr && row->is_probe(),
                   .axis = state_.tool_axis(),
                   .length = state_.tool_length(),
                   .radius = state_.tool_radius(),
                   .spindle_deg = state_.modes.spindle_deg,
                   .turns = state_.modes.turns()},
          .allowance = allowance_,
          .is_retract = is_retract};
}

MachineResult<double> Machine::follow(const Path& path, const Motion& motion) {
  const bool is_linear = path.is_straight || path.end.linear == path.start.linear;
  if (is_linear || axes_->capabilities().curves) return axes_->follow(path, motion);
  return follow_pieces(path, motion, 0, 1);
}

/// Halves the part of the path until each piece is straight.
MachineResult<double> Machine::follow_pieces(const Path& path, const Motion& motion, double from,
                                             double to) {
  constexpr double kLongestPiece = 0.125;
  const Position start = path.nose(from);
  const Position end = to < 1 ? path.nose(to) : path.end;
  const double half = (from + to) / 2;
  const Vec3 sag = path.nose(half).linear - (start.linear + end.linear) * 0.5;
  if (to - from > kLongestPiece || norm(sag) > tolerance::kSag) {
    auto first = follow_pieces(path, motion, from, half);
    if (!first || *first < half) return first;
    return follow_pieces(path, motion, half, to);
  }
  const auto part = axes_->follow(straight_path(start, end), motion);
  return part ? MachineResult<double>(*part < 1 ? from + (to - from) * *part : to) : part;
}

MachineResult<void> Machine::travel(const Path& path, const Feed& feed, bool is_retract) {
  const auto part = follow(path, motion(feed, is_retract));
  stand_at(axes_->nose());
  if (!part) return part.error();
  spend(seconds_of(*part * std::max(path.length, path.turn), feed));
  if (*part == 1) return {};
  const Vec3 centre = state_.ball_centre();
  return make_fault(FaultKind::Collision, "the ball stands at X{:+.4f} Y{:+.4f} Z{:+.4f}", centre.x,
                    centre.y, centre.z);
}

}  // namespace fitgauge::machine

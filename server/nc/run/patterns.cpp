#include "nc/machine/tolerance.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/machining.hpp"

/// Patterns of points: 220, 221 and PATTERN DEF run a machining cycle at each of them.
namespace fitgauge::interpreter {
namespace {

using machine::Feed;

/// 220: on a circle. A full turn has no point twice.
std::vector<Vec2> circle_points(const MachiningDefinition& pattern) {
  const auto count = static_cast<int>(pattern.value(241, 1));
  const double begin = pattern.value(245);
  const double span = pattern.value(246, 360) - begin;
  double step = pattern.value(247);
  if (step == 0) {
    const bool is_full = std::abs(std::abs(span) - 360) < tolerance::kSameAngle;
    step = count < 2 ? 0 : span / (is_full ? count : count - 1);
  }
  const Vec2 centre{pattern.value(216), pattern.value(217)};
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(centre + polar(pattern.value(244) / 2, begin + i * step));
  }
  return points;
}

/// 221: row by row, every second one backwards.
std::vector<Vec2> grid_points(const MachiningDefinition& pattern) {
  const auto columns = static_cast<int>(pattern.value(242, 1));
  const auto rows = static_cast<int>(pattern.value(243, 1));
  const Vec2 start{pattern.value(225), pattern.value(226)};
  std::vector<Vec2> points;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < columns; ++i) {
      const int column = row % 2 == 0 ? i : columns - 1 - i;
      const Vec2 offset{column * pattern.value(237), row * pattern.value(238)};
      points.push_back(start + turned(offset, pattern.value(224)));
    }
  }
  return points;
}

/// More points than these make no pattern.
constexpr double kMostPoints = 100'000;

}  // namespace

NcResult<void> run_pattern(Channel& channel, const MachiningDefinition& pattern) {
  const auto* before = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
  if (before == nullptr) return nc_error(1027);
  const bool is_circle = pattern.cycle->shape == MachiningShape::PolarPattern;
  const double count =
      is_circle ? pattern.value(241, 1) : pattern.value(242, 1) * pattern.value(243, 1);
  if (count > kMostPoints) return nc_error(1015, "a pattern has at most 100000 points");
  // The clearances and the surface of the pattern apply, not those of the cycle.
  MachiningDefinition cycle = *before;
  for (const int shared : {200, 203, 204}) cycle.values[shared] = pattern.value(shared);
  const double height = pattern.value(203) + std::max(pattern.value(200), pattern.value(204));
  const double between = pattern.value(301) == 1 ? height : pattern.value(203) + pattern.value(200);
  const auto points = is_circle ? circle_points(pattern) : grid_points(pattern);
  const Vec2 centre{pattern.value(216), pattern.value(217)};
  ToolMotion motion(channel.machine(), channel.budget);
  bool is_first = true;
  for (const Vec2 point : points) {
    auto done = motion.to_height(is_first ? height : between, Feed::rapid());
    const Vec2 from = motion.point();
    if (done && is_circle && pattern.value(365) == 1 && !is_first) {
      const double step = pattern.value(247) != 0 ? pattern.value(247) : 1;
      done = motion.arc(centre, point, sweep(from, point, centre, step > 0), motion.height(),
                        Feed::rapid());
    } else if (done) {
      done = motion.to_point(point, Feed::rapid());
    }
    is_first = false;
    if (done) done = machine_here(channel, cycle);
    if (!done) return done;
  }
  return {};
}

NcResult<void> run_points(Channel& channel) {
  const auto* active = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
  if (active == nullptr) return nc_error(1027);
  if (channel.active_cycle.pattern.empty()) {
    return nc_error(1017, "CYCL CALL PAT needs a PATTERN DEF before it");
  }
  const auto points = channel.active_cycle.pattern;
  ToolMotion motion(channel.machine(), channel.budget);
  for (const machine::Vec3& point : points) {
    MachiningDefinition cycle = *active;
    cycle.values[203] = active->value(203) + point.z;
    const double height = cycle.value(203) + std::max(cycle.value(200), cycle.value(204));
    auto done = motion.to_height(height, Feed::rapid());
    if (done) done = motion.to_point({point.x, point.y}, Feed::rapid());
    if (done) done = machine_here(channel, cycle);
    if (!done) return done;
  }
  return {};
}

}  // namespace fitgauge::interpreter

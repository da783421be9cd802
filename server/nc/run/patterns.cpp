#include "nc/run/statements.hpp"

/// Patterns of points: 220, 221 and PATTERN DEF run a machining cycle at each of them.
namespace fitgauge::interpreter {
namespace {

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
  for (int i = 0; i < count; ++i)
    points.push_back(centre + polar(pattern.value(244) / 2, begin + i * step));
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

using klartext::PatternElement;

constexpr std::size_t kMostPatternPoints = 10'000;

/// One element of PATTERN DEF with its values in mm and degrees.
struct PatternPart {
  PatternElement kind{};
  std::map<Letter, double> values{};

  double get(Letter letter, double otherwise = 0) const {
    const auto it = values.find(letter);
    return it == values.end() ? otherwise : it->second;
  }
  int count(Letter letter) const {
    return static_cast<int>(std::clamp<double>(get(letter, 1), 0, kMostPatternPoints + 1));
  }
};

constexpr klartext::LetterSet kLengths(Letter::X, Letter::Y, Letter::Z, Letter::D, Letter::Dx,
                                       Letter::Dy);

NcResult<std::vector<PatternPart>> read_elements(Channel& channel, Slice<Word> slice) {
  std::vector<PatternPart> elements;
  const auto words = channel.program().view(slice);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].letter == Letter::Element) {
      const auto kind = static_cast<int>(std::get<double>(words[i].value));
      elements.push_back({static_cast<PatternElement>(kind), {}});
      ++i;  // its number
      continue;
    }
    const auto value = TRY(number(channel, words[i].value));
    const double unit = kLengths.contains(words[i].letter) ? channel.length_unit() : 1;
    double from = 0;
    if (words[i].incremental) {
      if (elements.size() < 2)
        return nc_error("PATTERN DEF: the first element has none before it; write it without I");
      from = elements[elements.size() - 2].get(words[i].letter);
    }
    elements.back().values[words[i].letter] = from + value * unit;
  }
  return elements;
}

/// Rows along the main axis; FRAME uses only their border.
void add_grid(const PatternPart& element, std::vector<Vec2>& points) {
  const int columns = element.count(Letter::NumX);
  const int rows = element.count(Letter::NumY);
  if (columns == 0) return;
  const double rotation = element.get(Letter::Rot);
  const Vec2 along = turned({element.get(Letter::Dx), 0}, rotation + element.get(Letter::RotX));
  const Vec2 across = turned({0, element.get(Letter::Dy)}, rotation + element.get(Letter::RotY));
  for (int row = 0; row < rows && points.size() <= kMostPatternPoints; ++row) {
    for (int column = 0; column < columns && points.size() <= kMostPatternPoints; ++column) {
      const bool is_border = row == 0 || row == rows - 1 || column == 0 || column == columns - 1;
      if (element.kind == PatternElement::Frame && !is_border) continue;
      points.push_back(along * column + across * row);
    }
  }
}

void add_circle(const PatternPart& element, std::vector<Vec2>& points) {
  const int count = element.count(Letter::Num);
  const double step =
      element.kind == PatternElement::Circ ? 360.0 / std::max(count, 1) : element.get(Letter::Step);
  for (int i = 0; i < count && points.size() <= kMostPatternPoints; ++i)
    points.push_back(polar(element.get(Letter::D) / 2, element.get(Letter::Start) + i * step));
}

/// Relative to X, Y of the element.
std::vector<Vec2> points_of(const PatternPart& element) {
  std::vector<Vec2> points;
  switch (element.kind) {
    case PatternElement::Pos: points.push_back({}); break;
    case PatternElement::Row: {
      const Vec2 step = turned({element.get(Letter::D), 0}, element.get(Letter::Rot));
      for (int i = 0; i < element.count(Letter::Num) && points.size() <= kMostPatternPoints; ++i)
        points.push_back(step * i);
      break;
    }
    case PatternElement::Pat:
    case PatternElement::Frame: add_grid(element, points); break;
    case PatternElement::Circ:
    case PatternElement::PitchCirc: add_circle(element, points); break;
  }
  return points;
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::PatternDefinition& pattern) {
  const auto elements = TRY(read_elements(channel, pattern.words));
  std::vector<Vec3> all;
  for (const PatternPart& element : elements) {
    const Vec2 start{element.get(Letter::X), element.get(Letter::Y)};
    for (const Vec2 point : points_of(element)) {
      if (all.size() == kMostPatternPoints)
        return nc_error(1015, "PATTERN DEF has more than 10000 points");
      all.push_back({start.x + point.x, start.y + point.y, element.get(Letter::Z)});
    }
  }
  channel.active_cycle.pattern = std::move(all);
  return {};
}

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
    TRY(motion.to_height(is_first ? height : between, Feed::rapid()));
    if (is_circle && pattern.value(365) == 1 && !is_first) {
      const double step = pattern.value(247) != 0 ? pattern.value(247) : 1;
      TRY(motion.arc(centre, point, sweep(motion.point(), point, centre, step > 0), motion.height(),
                     Feed::rapid()));
    } else {
      TRY(motion.to_point(point, Feed::rapid()));
    }
    is_first = false;
    TRY(machine_here(channel, cycle));
  }
  return {};
}

NcResult<void> run_points(Channel& channel) {
  const auto* active = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
  if (active == nullptr) return nc_error(1027);
  if (channel.active_cycle.pattern.empty())
    return nc_error(1017, "CYCL CALL PAT needs a PATTERN DEF before it");
  const auto points = channel.active_cycle.pattern;
  ToolMotion motion(channel.machine(), channel.budget);
  for (const Vec3& point : points) {
    MachiningDefinition cycle = *active;
    cycle.values[203] = active->value(203) + point.z;
    const double height = cycle.value(203) + std::max(cycle.value(200), cycle.value(204));
    TRY(motion.to_height(height, Feed::rapid()));
    TRY(motion.to_point({point.x, point.y}, Feed::rapid()));
    TRY(machine_here(channel, cycle));
  }
  return {};
}

}  // namespace fitgauge::interpreter

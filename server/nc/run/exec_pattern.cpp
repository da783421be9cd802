#include "nc/run/channel.hpp"
#include "nc/run/plane_geometry.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Letter;
using klartext::PatternElement;
using klartext::Word;

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

bool is_length(Letter letter) {
  switch (letter) {
    case Letter::X:
    case Letter::Y:
    case Letter::Z:
    case Letter::D:
    case Letter::Dx:
    case Letter::Dy: return true;
    default: return false;
  }
}

NcResult<std::vector<PatternPart>> read_elements(Channel& channel, klartext::Slice<Word> slice) {
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
    const double unit = is_length(words[i].letter) ? channel.length_unit() : 1;
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
  for (int i = 0; i < count && points.size() <= kMostPatternPoints; ++i) {
    points.push_back(polar(element.get(Letter::D) / 2, element.get(Letter::Start) + i * step));
  }
}

/// Relative to X, Y of the element.
std::vector<Vec2> points_of(const PatternPart& element) {
  std::vector<Vec2> points;
  switch (element.kind) {
    case PatternElement::Pos: points.push_back({}); break;
    case PatternElement::Row: {
      const Vec2 step = turned({element.get(Letter::D), 0}, element.get(Letter::Rot));
      for (int i = 0; i < element.count(Letter::Num) && points.size() <= kMostPatternPoints; ++i) {
        points.push_back(step * i);
      }
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
  std::vector<machine::Vec3> all;
  for (const PatternPart& element : elements) {
    const Vec2 start{element.get(Letter::X), element.get(Letter::Y)};
    for (const Vec2 point : points_of(element)) {
      if (all.size() == kMostPatternPoints) {
        return nc_error(1015, "PATTERN DEF has more than 10000 points");
      }
      all.push_back({start.x + point.x, start.y + point.y, element.get(Letter::Z)});
    }
  }
  channel.active_cycle.pattern = std::move(all);
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::Dwell& dwell) {
  const auto value = TRY(number(channel, dwell.value));
  double seconds = value;
  if (dwell.revolutions) {
    const double rpm = channel.machine().state().modes.spindle_rpm;
    if (rpm <= 0) return nc_error(1020, "FUNCTION DWELL REV needs a speed of the spindle");
    seconds = value * 60 / rpm;
  }
  return checked(channel.machine().dwell(seconds));
}

}  // namespace fitgauge::interpreter

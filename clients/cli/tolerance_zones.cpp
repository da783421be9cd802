#include "cli/answers.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::size_t kIndent = 2;
constexpr std::size_t kZoneWidth = 8;
constexpr std::size_t kLabelWidth = 24;

std::string repeated(std::string_view piece, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += piece;
  return out;
}

std::string padded(std::string text, std::size_t width) {
  return text.append(width - std::min(width, tabfile::count_characters(text)), ' ');
}

/// The lines of the drawing are numbered from the zero line, 0: above it 1, 2, …, below it -1, -2,
/// …. Line n > 0 holds the deviations from (n - 1) to n times the height of a line.
class Scale {
 public:
  Scale(std::span<const ToleranceZone> zones, std::size_t rows)
      : farthest_(static_cast<std::int64_t>(std::max<std::size_t>(rows, 1))) {
    Length highest;
    Length lowest;
    for (const ToleranceZone& zone : zones) {
      highest = std::max(highest, zone.upper);
      lowest = std::min(lowest, zone.lower);
    }
    const std::int64_t quarters = 4 * farthest_;
    quarter_ = std::max<std::int64_t>(((highest - lowest).count() + quarters - 1) / quarters, 1);
  }

  /// The line that names an edge: the outermost one that shows the zone, or the zero line.
  std::int64_t upper_line(const ToleranceZone& zone) const {
    return zone.upper == Length() ? 0 : first_line(zone, farthest_, -1);
  }
  std::int64_t lower_line(const ToleranceZone& zone) const {
    return zone.lower == Length() ? 0 : first_line(zone, -farthest_, 1);
  }

  /// Returns whether the upper or lower half of a line shows the zone. It does if its middle is
  /// inside the zone, or if it contains the middle of the zone.
  bool shows(const ToleranceZone& zone, std::int64_t line, bool upper_half) const {
    if (line == 0) return zone.lower < Length() && zone.upper > Length();
    const std::int64_t floor = line > 0 ? (line - 1) * height() : line * height();
    const std::int64_t from = floor + (upper_half ? 2 * quarter_ : 0);
    const std::int64_t middle = from + quarter_;
    if (zone.lower.count() < middle && middle < zone.upper.count()) return true;
    const std::int64_t twice_middle = zone.lower.count() + zone.upper.count();
    return twice_middle != 0 && twice_middle >= 2 * from &&
           twice_middle < 2 * (from + 2 * quarter_);
  }

 private:
  /// The first line from `begin` on that shows the zone: there is one.
  std::int64_t first_line(const ToleranceZone& zone, std::int64_t begin, std::int64_t step) const {
    std::int64_t line = begin;
    while (!shows(zone, line, true) && !shows(zone, line, false)) line += step;
    return line;
  }
  std::int64_t height() const { return 4 * quarter_; }

  std::int64_t farthest_;     // no zone shows beyond this line on either side
  std::int64_t quarter_ = 1;  // a quarter of a line, in nm: the middles of its halves are whole
};

std::string_view piece_of(bool upper, bool lower, bool unicode) {
  if (!upper && !lower) return " ";
  if (!unicode) return "#";
  if (upper && lower) return "█";
  return upper ? "▀" : "▄";
}

std::string label_of(const ToleranceZone& zone, std::int64_t line, const Scale& scale,
                     const Terminal& terminal) {
  std::string label;
  if (scale.upper_line(zone) == line)
    label = fmt::format("{} {}", zone.upper_name, signed_text(format_um(zone.upper)));
  if (scale.lower_line(zone) == line) {
    if (!label.empty()) label += ", ";
    label += fmt::format("{} {}", zone.lower_name, signed_text(format_um(zone.lower)));
  }
  return label.empty() ? label : fmt::format(" {} {} ", label, terminal.micrometre());
}

std::string draw_line(std::span<const ToleranceZone> zones, std::int64_t line, const Scale& scale,
                      const Terminal& terminal) {
  const std::string_view ground = line != 0 ? " " : terminal.unicode ? "─" : "-";
  std::string out = repeated(ground, kIndent);
  for (const ToleranceZone& zone : zones) {
    std::string_view piece =
        piece_of(scale.shows(zone, line, true), scale.shows(zone, line, false), terminal.unicode);
    const bool is_zone = piece != " ";
    if (!is_zone) piece = ground;
    const std::string bar = repeated(piece, kZoneWidth);
    out += is_zone ? terminal.painted(bar, zone.colour) : bar;
    const std::string label = label_of(zone, line, scale, terminal);
    out += label +
           repeated(ground, kLabelWidth - std::min(kLabelWidth, tabfile::count_characters(label)));
  }
  return out;
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + '\n';
}

}  // namespace

std::string draw_zones(std::span<const ToleranceZone> zones, const std::string& zero_line,
                       const Terminal& terminal, std::size_t rows) {
  const Scale scale(zones, rows);
  std::string headings(kIndent, ' ');
  std::int64_t top = 0;
  std::int64_t bottom = 0;
  for (const ToleranceZone& zone : zones) {
    headings += padded(zone.heading, kZoneWidth + kLabelWidth);
    top = std::max(top, scale.upper_line(zone));
    bottom = std::min(bottom, scale.lower_line(zone));
  }
  std::string out;
  append_line(out, std::move(headings));
  for (std::int64_t line = top; line >= bottom; --line) {
    std::string text = draw_line(zones, line, scale, terminal);
    if (line == 0) text += ' ' + zero_line;
    append_line(out, std::move(text));
  }
  return out;
}

}  // namespace fitgauge::cli

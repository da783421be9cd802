#include "nc/probing/measuring/probing_3d_log.hpp"

#include "base/length.hpp"
#include "log_templates.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;
using gauging::Verdict;
using machine::Vec3;

constexpr HtmlLog k444Log{"TCHPR444.html", "Measuring log of cycle 444",
                          "Measuring log of touch-probe cycle 444 PROBING IN 3-D",
                          "Along the normal, positive is away from the material."};

/// Style of a verdict: colour, border and word.
struct Appearance {
  std::string_view style;
  std::string_view words;
  int q183;
};

Appearance appearance(const std::optional<Verdict>& verdict) {
  if (!verdict) return {"none", "– No tolerance", -1};
  switch (*verdict) {
    case Verdict::Good: return {"good", "✓ Good", 0};
    case Verdict::Rework: return {"rework", "▲ Rework: above the upper limit", 1};
    default: return {"scrap", "✗ Scrap: below the lower limit", 2};
  }
}

/// Styles of the values along the axes and along the normal.
using Styles = std::array<std::string_view, 4>;

/// A row of a value along each axis and one along the normal.
std::string row(std::string_view label, const std::array<Length, 3>& along_axes,
                Length along_normal, bool inch, const Styles& styles = {}) {
  const auto cell = [&](Length value, std::string_view style) {
    const std::string text = log_text(value, inch);
    return style.empty()
               ? fmt::format(templates::point::cell, "value"_a = text)
               : fmt::format(templates::point::judged_cell, "style"_a = style, "value"_a = text);
  };
  return fmt::format(
      templates::point::row, "label"_a = label, "main"_a = cell(along_axes[0], styles[0]),
      "secondary"_a = cell(along_axes[1], styles[1]), "probe"_a = cell(along_axes[2], styles[2]),
      "normal"_a = cell(along_normal, styles[3]));
}

std::array<Length, 3> components(const Vec3& normal, double length) {
  return {to_length(normal.x * length), to_length(normal.y * length), to_length(normal.z * length)};
}

/// Styles of each axis by its share of the tolerance (decision 24), and last along the normal.
/// Deviations across the normal have no share.
Styles styles_of(const ProbedPoint& point) {
  Styles styles{};
  if (!point.limits) return styles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double share = point.normal[axis];
    const double away = (point.measured[axis] - point.nominal[axis]).to_mm() * (share < 0 ? -1 : 1);
    const auto limit = [&](Length along_normal) {
      return to_length(along_normal.to_mm() * std::abs(share));
    };
    if (limit(point.limits->upper) == limit(point.limits->lower)) continue;
    const Length value = to_length(away);
    const Verdict verdict = value > limit(point.limits->upper)   ? Verdict::Rework
                            : value < limit(point.limits->lower) ? Verdict::Reject
                                                                 : Verdict::Good;
    styles.at(axis) = appearance(verdict).style;
  }
  styles.back() = appearance(point.verdict).style;
  return styles;
}

std::array<Length, 3> sum(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::array<Length, 3> difference(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

std::string rows(const ProbedPoint& point, bool inch) {
  std::string rows = row("Probing direction vector", components(point.normal, -point.distance),
                         to_length(-point.distance), inch) +
                     row("Nominal", point.nominal, Length{}, inch);
  if (point.limits) {
    const auto limit = [&](std::string_view label, Length along_normal) {
      return row(label, sum(point.nominal, components(point.normal, along_normal.to_mm())),
                 along_normal, inch);
    };
    rows += limit("Upper limit", point.limits->upper) + limit("Lower limit", point.limits->lower);
  }
  const Styles styles = styles_of(point);
  rows += row("Actual", point.measured, point.deviation, inch, styles);
  rows +=
      row("Deviation", difference(point.measured, point.nominal), point.deviation, inch, styles);
  return rows;
}

std::string section(const CycleHost& host, const ProbedPoint& point) {
  const Appearance look = appearance(point.verdict);
  return fmt::format(templates::point::section, "when"_a = date_and_time(host),
                     "style"_a = look.style, "words"_a = look.words, "q183"_a = look.q183,
                     "main"_a = name(point.plane.main), "secondary"_a = name(point.plane.secondary),
                     "probe"_a = name(point.plane.probe), "rows"_a = rows(point, host.is_inch()));
}

}  // namespace

CycleResult<void> log_probed_point(CycleHost& host, const ProbedPoint& point) {
  return add_section(host, k444Log, section(host, point));
}

}  // namespace fitgauge::probing

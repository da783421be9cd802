#include "probing/measuring/probing_3d_log.hpp"

#include <fmt/format.h>

#include <cmath>

#include "probing/log/html_log.hpp"
#include "probing/log/measuring_log.hpp"
#include "probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using gauging::Verdict;
using machine::Vec3;

constexpr HtmlLog kLog{"TCHPR444.html", "Measuring log of cycle 444",
                       "Measuring log of touch-probe cycle 444 PROBING IN 3-D",
                       "Along the normal, positive is away from the material."};

/// How a verdict looks: by colour, by its border and in words.
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

/// Of the values along the axes and along the normal.
using Styles = std::array<std::string_view, 4>;

/// Adds rows of a value along each axis and one along the normal.
class PointTable {
 public:
  PointTable(std::string& html, bool inch) : html_(html), inch_(inch) {}

  void row(std::string_view label, const std::array<Length, 3>& along_axes, Length along_normal,
           const Styles& styles = {}) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", label);
    for (std::size_t axis = 0; axis < 3; ++axis) cell(along_axes.at(axis), styles.at(axis));
    cell(along_normal, styles.back());
    html_ += "</tr>\n";
  }

 private:
  void cell(Length value, std::string_view style) {
    const std::string begin =
        style.empty() ? std::string("<td>") : fmt::format("<td class=\"judged {}\">", style);
    html_ += fmt::format("{}{}</td>", begin, log_text(value, inch_));
  }

  std::string& html_;
  bool inch_;
};

std::array<Length, 3> components(const Vec3& normal, double length) {
  return {to_length(normal.x * length), to_length(normal.y * length), to_length(normal.z * length)};
}

/// Each axis against its share of the tolerance (decision 24), the last along the normal. What lies
/// across the normal has no share.
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

std::string section(const CycleHost& host, const ProbedPoint& point) {
  const Appearance look = appearance(point.verdict);
  std::string html = fmt::format(
      "<section>\n<h2>Point touched on {}</h2>\n"
      "<p class=\"verdict {}\">{} (Q183 = {})</p>\n"
      "<table>\n<thead><tr><th scope=\"col\">Value</th><th scope=\"col\">{}</th>"
      "<th scope=\"col\">{}</th><th scope=\"col\">{}</th>"
      "<th scope=\"col\">Along the normal</th></tr></thead>\n<tbody>\n",
      date_and_time(host), look.style, look.words, look.q183, name(point.plane.main),
      name(point.plane.secondary), name(point.plane.probe));
  PointTable table(html, host.is_inch());
  table.row("Probing direction vector", components(point.normal, -point.distance),
            to_length(-point.distance));
  table.row("Nominal", point.nominal, Length{});
  if (point.limits) {
    const auto limit = [&](std::string_view label, Length along_normal) {
      table.row(label, sum(point.nominal, components(point.normal, along_normal.to_mm())),
                along_normal);
    };
    limit("Upper limit", point.limits->upper);
    limit("Lower limit", point.limits->lower);
  }
  const Styles styles = styles_of(point);
  table.row("Actual", point.measured, point.deviation, styles);
  table.row("Deviation", difference(point.measured, point.nominal), point.deviation, styles);
  html += "</tbody>\n</table>\n</section>\n";
  return html;
}

}  // namespace

CycleResult<void> log_probed_point(CycleHost& host, const ProbedPoint& point) {
  return add_section(host, kLog, section(host, point));
}

}  // namespace fitgauge::probing

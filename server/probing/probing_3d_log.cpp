#include "probing/probing_3d_log.hpp"

#include <fmt/format.h>

#include "probing/measured_value.hpp"
#include "probing/measuring_log.hpp"

namespace fitgauge::probing {
namespace {

using gauging::Verdict;
using machine::Vec3;

constexpr std::string_view kFileName = "TCHPR444.html";

/// Sections follow: HTML lets a page end without the end tags of body and html, so that points can
/// be appended.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Measuring log of cycle 444</title>
<style>
:root { color-scheme: light; }
body { font: 16px/1.5 "Segoe UI", Roboto, "DejaVu Sans", sans-serif; color: #1b2733;
  background: #eef1f4; margin: 0 auto; padding: 2rem 1rem; max-width: 56rem; }
header, section { background: #fff; border: 1px solid #ccd4dc; border-radius: 8px;
  padding: 1.25rem 1.5rem; margin-bottom: 1.25rem; overflow-x: auto; }
h1 { font-size: 1.4rem; margin: 0 0 .5rem; }
h2 { font-size: 1.05rem; margin: 0; }
p { margin: .25rem 0; overflow-wrap: anywhere; }
.verdict { display: inline-block; margin: .75rem 0; padding: .3rem .9rem; border-radius: 6px;
  border: 2px solid; font-weight: 700; }
.good { color: #0b5a26; background: #d9f2e0; border-color: #1c8a43; }
.rework { color: #7a3d00; background: #ffe8c7; border-color: #e07b00; border-style: dashed; }
.scrap { color: #8c1119; background: #fbdcde; border-color: #cc2430; border-style: double;
  border-width: 4px; }
.none { color: #44525f; background: #edf0f3; border-color: #8896a3; border-style: dotted; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .4rem .6rem; text-align: right; border-bottom: 1px solid #dde3e8; }
thead th { border-bottom: 2px solid #5d6b78; }
th:first-child { text-align: left; font-weight: 600; }
td.judged { font-weight: 700; border: 2px solid; }
@media print {
  body { background: none; padding: 0; font-size: 11pt; max-width: none; }
  header, section { border-radius: 0; break-inside: avoid; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style>
</head>
<body>
)";

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

/// Adds rows of a value along each axis and one along the normal.
class PointTable {
 public:
  PointTable(std::string& html, bool inch) : html_(html), inch_(inch) {}

  void row(std::string_view label, const std::array<Length, 3>& along_axes, Length along_normal,
           std::string_view style = {}) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", label);
    for (const Length value : along_axes) cell(value, {});
    cell(along_normal, style);
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

std::array<Length, 3> sum(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::array<Length, 3> difference(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// A text as HTML shows it, in elements and in quoted attributes.
std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

std::string header(const CycleHost& host) {
  return fmt::format(
      "<header>\n<h1>Measuring log of touch-probe cycle 444 PROBING IN 3-D</h1>\n"
      "<p>Measuring program: {}</p>\n<p>Lengths in {}. Along the normal, positive is away from "
      "the material.</p>\n</header>\n",
      escape_html(host.program_path()), host.is_inch() ? "inch" : "mm");
}

std::string section(const CycleHost& host, const ProbedPoint& point) {
  const Appearance look = appearance(point.verdict);
  const CivilTime time = civil_time(host.now());
  std::string html = fmt::format(
      "<section>\n<h2>Point touched on {:02}-{:02}-{:04} at {}:{:02}:{:02}</h2>\n"
      "<p class=\"verdict {}\">{} (Q183 = {})</p>\n"
      "<table>\n<thead><tr><th scope=\"col\">Value</th><th scope=\"col\">{}</th>"
      "<th scope=\"col\">{}</th><th scope=\"col\">{}</th>"
      "<th scope=\"col\">Along the normal</th></tr></thead>\n<tbody>\n",
      time.day, time.month, time.year, time.hour, time.minute, time.second, look.style, look.words,
      look.q183, name(point.plane.main), name(point.plane.secondary), name(point.plane.probe));
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
  table.row("Actual", point.measured, point.deviation, look.style);
  table.row("Deviation", difference(point.measured, point.nominal), point.deviation, look.style);
  html += "</tbody>\n</table>\n</section>\n";
  return html;
}

}  // namespace

CycleResult<void> log_probed_point(CycleHost& host, const ProbedPoint& point) {
  const std::string text = section(host, point);
  const bool is_first = host.memory().programs_with_log_444.emplace(host.program_path()).second;
  if (!is_first) return host.append_log(kFileName, text);
  return host.write_log(kFileName, std::string(kHead) + header(host) + text);
}

}  // namespace fitgauge::probing

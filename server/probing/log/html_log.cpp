#include "probing/log/html_log.hpp"

#include <fmt/format.h>

namespace fitgauge::probing {
namespace {

constexpr std::string_view kStyle = R"(<style>
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
)";

/// Sections follow: HTML lets a page end without the end tags of body and html, so that sections
/// can be appended.
std::string beginning(const CycleHost& host, const HtmlLog& log) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n{}<body>\n"
      "<header>\n<h1>{}</h1>\n<p>Measuring program: {}</p>\n<p>Lengths in {}.{}{}</p>\n</header>\n",
      log.title, kStyle, log.heading, escape_html(host.program_path()),
      host.is_inch() && !log.is_metric ? "inch" : "mm", log.note.empty() ? "" : " ", log.note);
}

}  // namespace

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

std::string date_and_time(const CycleHost& host) {
  const CivilTime time = civil_time(host.now());
  return fmt::format("{:02}-{:02}-{:04} at {}:{:02}:{:02}", time.day, time.month, time.year,
                     time.hour, time.minute, time.second);
}

CycleResult<void> add_section(CycleHost& host, const HtmlLog& log, std::string_view section) {
  const bool is_first = host.memory().begun_logs.emplace(log.file_name, host.program_path()).second;
  if (!is_first) return host.append_log(log.file_name, section);
  return host.write_log(log.file_name, beginning(host, log) + std::string(section));
}

}  // namespace fitgauge::probing

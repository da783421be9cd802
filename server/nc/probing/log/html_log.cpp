#include "nc/probing/log/html_log.hpp"

#include <fmt/format.h>

#include "log_templates.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;

std::string beginning(const CycleHost& host, const HtmlLog& log) {
  return fmt::format(templates::page::beginning, "title"_a = log.title,
                     "style"_a = templates::page::style, "heading"_a = log.heading,
                     "program"_a = escape_html(host.program_path()),
                     "unit"_a = host.is_inch() && !log.is_metric ? "inch" : "mm",
                     "note"_a = log.note.empty() ? "" : fmt::format(" {}", log.note));
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
  return fmt::format(templates::page::date_and_time, "day"_a = time.day, "month"_a = time.month,
                     "year"_a = time.year, "hour"_a = time.hour, "minute"_a = time.minute,
                     "second"_a = time.second);
}

CycleResult<void> add_section(CycleHost& host, const HtmlLog& log, std::string_view section) {
  const bool is_first = host.memory().begun_logs.emplace(log.file_name, host.program_path()).second;
  if (!is_first) return host.append_log(log.file_name, section);
  return host.write_log(log.file_name, beginning(host, log) + std::string(section));
}

}  // namespace fitgauge::probing

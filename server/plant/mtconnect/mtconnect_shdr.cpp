#include "plant/mtconnect/mtconnect_shdr.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace fitgauge::api::mtconnect {

std::string shdr_text(std::string_view text) {
  std::string plain(text);
  std::replace_if(
      plain.begin(), plain.end(),
      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, ' ');
  plain = trim(plain);
  if (plain.empty()) return std::string(kUnavailable);
  if (plain.front() != '"' && plain.find('|') == plain.npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) {
    if (c == '|' || c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string shdr_availability(Timestamp at) {
  return fmt::format("{}|avail|AVAILABLE\n", format_rfc3339(at));
}

std::string shdr_line(const app::Measurement& measurement) {
  std::string cells;
  for (const auto& [key, text] : cells_of(measurement)) {
    cells += fmt::format("{}{}={}", cells.empty() ? "" : " ", key, text);
  }
  return fmt::format("{}|part|{}|feature|{}={{{}}}\n", format_rfc3339(measurement.received_at),
                     shdr_text(measurement.part_id.value_or("")), entry_of(measurement), cells);
}

std::string shdr_line(const Counts& counts, Timestamp at) {
  std::string line = format_rfc3339(at);
  for (const auto& [id, count] : counts_by_item(counts)) line += fmt::format("|{}|{}", id, count);
  return line + '\n';
}

}  // namespace fitgauge::api::mtconnect

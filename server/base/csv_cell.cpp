#include "base/csv_cell.hpp"

#include <algorithm>
#include <array>

namespace fitgauge::sheet {
namespace {

using Characters = std::array<bool, 256>;

constexpr Characters characters(std::string_view text) {
  Characters of{};
  for (const char c : text) of[static_cast<unsigned char>(c)] = true;
  return of;
}
constexpr Characters kQuoted = characters(",;\"\r\n");
constexpr Characters kQuotedBesideSemicolons = characters(";\"\r\n");

/// Also true of a text that is guarded already, so that reading takes off exactly one guard.
bool begins_formula(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos &&
         std::string_view("=+-@\t\r\n").find(text[first]) != std::string_view::npos;
}

void append(std::string& out, std::string_view guard, std::string_view text,
            CsvSeparator separator) {
  const Characters& quoted = separator == CsvSeparator::Comma ? kQuoted : kQuotedBesideSemicolons;
  const bool is_quoted = std::any_of(text.begin(), text.end(),
                                     [&](char c) { return quoted[static_cast<unsigned char>(c)]; });
  if (!is_quoted) {
    out += guard;
    out += text;
    return;
  }
  out += '"';
  out += guard;
  for (const char c : text) {
    if (c == '"') out += c;
    out += c;
  }
  out += '"';
}

}  // namespace

void append_csv_cell(std::string& out, std::string_view text, CsvSeparator separator) {
  append(out, "", text, separator);
}

void append_csv_text(std::string& out, std::string_view text, CsvSeparator separator) {
  append(out, begins_formula(text) ? "'" : "", text, separator);
}

std::string_view without_formula_guard(std::string_view text) {
  return text.starts_with('\'') && begins_formula(text) ? text.substr(1) : text;
}

}  // namespace fitgauge::sheet

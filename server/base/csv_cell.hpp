#pragma once

#include <string>
#include <string_view>

// The one writer of CSV cells.

namespace fitgauge::sheet {

/// What stands between the cells. Where it is a semicolon, a comma is of a number.
enum class CsvSeparator : char { Comma = ',', Semicolon = ';' };

/// Appends `text` as a CSV cell, quoted where a separator, a quote or a line end wants it.
void append_csv_cell(std::string& out, std::string_view text,
                     CsvSeparator separator = CsvSeparator::Comma);

/// The same of a text that somebody chose: an apostrophe stands before one that a spreadsheet would
/// run as a formula (it begins with `=`, `+`, `-`, `@`, a tab or a line end).
void append_csv_text(std::string& out, std::string_view text,
                     CsvSeparator separator = CsvSeparator::Comma);

/// What append_csv_text was given.
std::string_view without_formula_guard(std::string_view text);

}  // namespace fitgauge::sheet

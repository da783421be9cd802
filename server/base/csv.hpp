#pragma once

#include "base/json/text_arena.hpp"

namespace fitgauge::sheet {

// The one writer of CSV cells.

/// The separator of cells. With a semicolon, a comma belongs to a number.
enum class CsvSeparator : char { Comma = ',', Semicolon = ';' };

/// Appends `text` as a CSV cell, quoted if it has a separator, a quote or a line end.
void append_csv_cell(std::string& out, std::string_view text,
                     CsvSeparator separator = CsvSeparator::Comma);

/// Appends a text from outside as a CSV cell, with an apostrophe before a text that a spreadsheet
/// would run as a formula (it begins with `=`, `+`, `-`, `@`, a tab or a line end).
void append_csv_text(std::string& out, std::string_view text,
                     CsvSeparator separator = CsvSeparator::Comma);

/// The text that append_csv_text received.
std::string_view without_formula_guard(std::string_view text);

}  // namespace fitgauge::sheet

namespace fitgauge::api {

struct CsvCell {
  std::string_view text;  ///< without the quotes, doubled quotes undone
  bool quoted = false;
};

/// Reads CSV (RFC 4180) with `,` or `;` between the cells, whichever the header line has; LF, CRLF
/// and a byte-order mark are accepted. Cells stay valid as long as the reader and its text.
class CsvReader {
 public:
  /// @errors TextEncoding, CsvMalformed (no header line).
  static Result<CsvReader> open(std::string_view text);

  const std::vector<std::string>& header() const { return header_; }
  char separator() const { return separator_; }

  /// Returns the next record with text, or none at the end; skips blank lines.
  /// @errors CsvMalformed naming the line: an open quote, text after a closing quote, or a number
  ///   of cells that differs from the header.
  Result<const std::vector<CsvCell>*> next();

  /// The line the last record began on, from 1.
  std::size_t line() const { return record_line_; }

 private:
  CsvReader(std::string_view text, char separator) : rest_(text), separator_(separator) {}

  Result<void> read_record();
  Result<void> read_quoted();
  void read_plain();
  bool take_line_end();
  Error malformed(std::string_view what) const;

  std::string_view rest_;
  char separator_;
  std::size_t line_ = 1;
  std::size_t record_line_ = 1;
  std::vector<std::string> header_;
  std::vector<CsvCell> cells_;
  std::unique_ptr<TextArena>
      unescaped_ =  // cells whose doubled quotes were undone, of every record
      std::make_unique<TextArena>();
  std::string plain_;
};

}  // namespace fitgauge::api

#pragma once

#include "base/allowance.hpp"

namespace fitgauge::tabfile {

/// A column of a table file.
struct TabColumn {
  std::string name;
  /// Type as in the file: `N`, `C`, `LENGTH`, `TEXT`; empty if the file has none.
  std::string type{};
  std::size_t width = 0;  ///< characters of a cell, without the blank between columns
  /// Digits after the point of a written number; none if the file does not define them.
  std::optional<int> decimals{};

  friend bool operator==(const TabColumn&, const TabColumn&) = default;
};

/// Form of the column descriptions between the BEGIN line and the line of their names.
enum class HeaderForm : std::uint8_t {
  None,              ///< not at all
  StructBlock,       ///< iTNC: #STRUCTBEGIN ... #STRUCTEND
  TableDescription,  ///< TNC 640 and TNC7: TableDescription ( ... )
};

/// The first line: `BEGIN 82101_IT .TAB MM`.
struct TabHeader {
  std::string name;       ///< with its suffix, as written: `82101_IT .TAB`
  std::string unit{};     ///< `MM`, `INCH` or empty
  std::string version{};  ///< text after the unit, as written
  HeaderForm form = HeaderForm::StructBlock;

  friend bool operator==(const TabHeader&, const TabHeader&) = default;
};

/// A freely definable table of the control, or a tool, probe or preset table: rows of text cells
/// under named columns. Rows are addressed by the number in their first column (NR, NO, T); names
/// of columns are case-sensitive (H7 and h7 differ). Owns its cells. Not thread-safe while written;
/// after a failed write it is unchanged.
class TabTable {
 public:
  /// @pre at least one column, names not empty and unique
  TabTable(TabHeader header, std::vector<TabColumn> columns);

  const TabHeader& header() const { return header_; }
  const std::vector<TabColumn>& columns() const { return columns_; }
  std::size_t row_count() const { return rows_.size(); }

  /// The cell of the row in file order, trimmed; empty when blank.
  std::string_view cell(std::size_t row, std::size_t column) const;

  /// Appends a row; missing cells are blank.
  /// @errors TableFileMalformed if its number exists or it has more cells than columns.
  Result<void> append_row(const std::vector<std::string_view>& cells);

  /// @errors TableColumnMissing.
  Result<std::size_t> find_column(std::string_view name) const;

  /// @errors TableRowMissing.
  Result<std::size_t> find_row(std::int64_t number) const;

  /// The value of a cell in the column's unit; the nearest double to the decimal in the file, whose
  /// mark may be a comma.
  /// @errors TableRowMissing, TableColumnMissing, TableCellEmpty; NumberMalformed for text.
  Result<double> number(std::int64_t row, std::string_view column) const;

  /// The text of a cell, blank cells included.
  /// @errors TableRowMissing, TableColumnMissing.
  Result<std::string_view> text(std::int64_t row, std::string_view column) const;

  /// Writes a value with the decimals of the column; without, as it is, with as many as fit.
  /// @errors as set_text; NumberOutOfRange when it is not finite.
  Result<void> set_number(std::int64_t row, std::string_view column, double value);

  /// @errors TableRowMissing, TableColumnMissing, TableCellTooLong; FieldInvalid for the first
  ///   column, which numbers the rows, and for a control character; NumberMalformed for a text in
  ///   a column of numbers.
  Result<void> set_text(std::int64_t row, std::string_view column, std::string_view value);

  friend bool operator==(const TabTable& left, const TabTable& right);

 private:
  struct Place {
    std::size_t row;
    std::size_t column;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::optional<std::int64_t> number_of(std::size_t row) const;
  Result<Place> find(std::int64_t row, std::string_view column) const;

  TabHeader header_;
  std::vector<TabColumn> columns_;
  std::map<std::string, std::size_t, std::less<>> columns_by_name_;
  std::string text_;                 ///< cells of the appended rows, without trailing blank ones
  std::vector<std::uint32_t> ends_;  ///< of the cells in text_
  std::vector<std::uint32_t> rows_;  ///< count of cells up to the end of each row
  std::map<Place, std::string> changed_;        ///< cells written since
  std::vector<std::uint32_t> ascending_;        ///< rows whose number is above all before
  std::map<std::int64_t, std::size_t> others_;  ///< the other numbered rows
};

/// Writes a table in the form that its header names; read_tab_file returns an equal table.
std::string write_tab(const TabTable& table);

/// Reads a table file in any form of the controls: columns described by #STRUCTBEGIN, by
/// TableDescription or not at all, comment lines before the column names, LF or CRLF. The names in
/// the column line begin where their columns begin; every row is cut there. A file may hold up to
/// 4096 columns, a million cells and a million lines.
/// @param bytes UTF-8, a byte order mark allowed, or Windows-1252 as older controls write it
/// @errors TableFileMalformed, `where` names the line: no BEGIN, an unfinished description, no
///   column line, a name twice, a cell that runs into the next, a row number twice, no [END], text
///   after [END].
/// Reading leaves off with that error, too, once `allowance` is spent.
Result<TabTable> read_tab_file(std::string_view bytes, Allowance& allowance);

/// Maximum number of columns; reading ends at a description with more.
inline constexpr std::size_t kMostColumns = 4096;

}  // namespace fitgauge::tabfile

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace fitgauge::tabfile {

/// A column of a table file.
struct TabColumn {
  std::string name;
  /// The type as the file gives it: `N`, `C`, `LENGTH`, `TEXT`; empty where it describes none.
  std::string type{};
  std::size_t width = 0;  ///< characters of a cell, without the blank between columns
  /// Digits after the point of a number that is written; nothing where the file does not tell.
  std::optional<int> decimals{};

  /// Whether a read gives a string: for text types, and for undescribed columns never.
  bool is_text() const;

  friend bool operator==(const TabColumn&, const TabColumn&) = default;
};

/// How the columns are described between the BEGIN line and the line of their names.
enum class HeaderForm : std::uint8_t {
  None,              ///< not at all
  StructBlock,       ///< iTNC: #STRUCTBEGIN ... #STRUCTEND
  TableDescription,  ///< TNC 640 and TNC7: TableDescription ( ... )
};

/// The first line: `BEGIN 82101_IT .TAB MM`.
struct TabHeader {
  std::string name;       ///< with its suffix, as written: `82101_IT .TAB`
  std::string unit{};     ///< `MM`, `INCH` or empty
  std::string version{};  ///< what follows the unit, as written
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

  /// Appends a row; cells it lacks are blank.
  /// @errors TableFileMalformed when its number is taken or it has more cells than columns.
  Result<void> append_row(std::vector<std::string> cells);

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
  ///   column, which numbers the rows.
  Result<void> set_text(std::int64_t row, std::string_view column, std::string_view value);

  friend bool operator==(const TabTable&, const TabTable&) = default;

 private:
  struct Place {
    std::size_t row;
    std::size_t column;
  };
  Result<Place> find(std::int64_t row, std::string_view column) const;

  TabHeader header_;
  std::vector<TabColumn> columns_;
  std::map<std::string, std::size_t, std::less<>> columns_by_name_;
  std::vector<std::vector<std::string>> rows_;  ///< without trailing blank cells
  std::map<std::int64_t, std::size_t> rows_by_number_;
};

/// The file of a table in the form its header names; read_tab gives the same table back.
std::string write_tab(const TabTable& table);

}  // namespace fitgauge::tabfile

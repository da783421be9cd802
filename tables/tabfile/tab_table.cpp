#include "tables/tabfile/tab_table.hpp"

#include <cassert>

#include "tables/tabfile/characters.hpp"

namespace fitgauge::tabfile {
namespace {

/// The whole of `text` as a number, a leading plus sign allowed.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  return read_number<Number>(text);
}

/// A finite number with `,` or `.` as its decimal mark.
std::optional<double> to_decimal(std::string_view text) {
  std::string pointed(text);
  if (pointed.find('.') == std::string::npos) {
    const std::size_t mark = pointed.find(',');
    if (mark != std::string::npos) pointed[mark] = '.';
  }
  const auto value = to_number<double>(pointed);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Types of columns that hold decimal numbers.
constexpr std::array<std::string_view, 8> kNumericTypes{"N",   "L",     "LENGTH", "FEED",
                                                        "INT", "IFEED", "FLOAT",  "DEC"};

/// To 1 nm without trailing zeros, with fewer decimals if they do not fit.
std::string shortest(double value, std::size_t width) {
  for (int decimals = 6;; --decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    if (text == "-0") text = "0";
    if (text.size() <= width || decimals == 0) return text;
  }
}

std::string place_of(std::int64_t row, std::string_view column) {
  return fmt::format("row {}, column {}", row, column);
}

/// Appends a cell and the blanks up to the next column.
void append_cell(std::string& line, std::string_view text, const TabColumn& column) {
  const std::size_t width = std::max(column.width, count_characters(column.name)) + 1;
  line += text;
  line.append(width - std::min(width, count_characters(text)), ' ');
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line;
  out += '\n';
}

std::string begin_line(const TabHeader& header) {
  std::string line = "BEGIN " + header.name;
  for (const std::string& part : {header.unit, header.version}) {
    if (!part.empty()) line += " " + part;
  }
  return line;
}

/// Returns whether a column has data that its name and place do not define. The width of the last
/// column does not count.
bool is_described(const TabTable& table, const TabColumn& column) {
  const bool is_last = &column == &table.columns().back();
  return !column.type.empty() || column.decimals || is_last;
}

/// The description of all columns that have a type, as the lines of their form.
std::string write_description(const TabTable& table) {
  std::string out;
  if (table.header().form == HeaderForm::StructBlock) {
    out += "#STRUCTBEGIN\n";
    for (const TabColumn& column : table.columns()) {
      if (!is_described(table, column)) continue;
      out += fmt::format("   NAME = {}\n     TYPE = {}\n     WIDTH = {}\n", column.name,
                         column.type, column.width);
      if (column.decimals) out += fmt::format("     DEC = {}\n", *column.decimals);
    }
    out += "#STRUCTEND\n";
  }
  if (table.header().form == HeaderForm::TableDescription) {
    out += "TableDescription (\n  columns:=[\n";
    for (const TabColumn& column : table.columns()) {
      if (!is_described(table, column)) continue;
      out += fmt::format("    CfgColumnDescription ( key:=\"{}\", width:={}, ", column.name,
                         column.width);
      if (column.decimals) out += fmt::format("decimals:={}, ", *column.decimals);
      out += fmt::format("unit:=\"{}\" ),\n", column.type);
    }
    out += "  ]\n)\n";
  }
  return out;
}

}  // namespace

TabTable::TabTable(TabHeader header, std::vector<TabColumn> columns)
    : header_(std::move(header)), columns_(std::move(columns)) {
  assert(!columns_.empty());
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_by_name_.emplace(columns_[i].name, i);
}

std::string_view TabTable::cell(std::size_t row, std::size_t column) const {
  if (const auto written = changed_.find({row, column}); written != changed_.end())
    return written->second;
  const std::size_t at = (row == 0 ? 0 : rows_[row - 1]) + column;
  if (at >= rows_[row]) return {};
  const std::size_t begin = at == 0 ? 0 : ends_[at - 1];
  return std::string_view(text_).substr(begin, ends_[at] - begin);
}

std::optional<std::int64_t> TabTable::number_of(std::size_t row) const {
  return to_number<std::int64_t>(cell(row, 0));
}

Result<void> TabTable::append_row(const std::vector<std::string_view>& cells) {
  std::size_t count = cells.size();
  while (count > 0 && cells[count - 1].empty()) --count;
  if (count > columns_.size()) {
    return Error{ErrorCode::TableFileMalformed, "a row has more cells than the table has columns"};
  }
  if (const auto number = count == 0 ? std::nullopt : to_number<std::int64_t>(cells.front())) {
    if (find_row(*number)) {
      return Error{ErrorCode::TableFileMalformed, fmt::format("row {} is repeated", *number)};
    }
    if (ascending_.empty() || *number > number_of(ascending_.back()))
      ascending_.push_back(static_cast<std::uint32_t>(rows_.size()));
    else
      others_.emplace(*number, rows_.size());
  }
  for (std::size_t i = 0; i < count; ++i) {
    text_ += cells[i];
    ends_.push_back(static_cast<std::uint32_t>(text_.size()));
  }
  rows_.push_back(static_cast<std::uint32_t>(ends_.size()));
  return {};
}

Result<std::size_t> TabTable::find_column(std::string_view name) const {
  const auto found = columns_by_name_.find(name);
  if (found != columns_by_name_.end()) return found->second;
  return Error{ErrorCode::TableColumnMissing,
               fmt::format("table {} has no column '{}'", header_.name, name)};
}

Result<std::size_t> TabTable::find_row(std::int64_t number) const {
  const auto found = std::ranges::lower_bound(ascending_, std::optional(number), {},
                                              [this](std::size_t row) { return number_of(row); });
  if (found != ascending_.end() && number_of(*found) == number) return *found;
  if (const auto other = others_.find(number); other != others_.end()) return other->second;
  return Error{ErrorCode::TableRowMissing,
               fmt::format("table {} has no row {} in its column {}", header_.name, number,
                           columns_.front().name)};
}

Result<TabTable::Place> TabTable::find(std::int64_t row, std::string_view column) const {
  const auto row_index = TRY(find_row(row));
  const auto column_index = TRY(find_column(column));
  return Place{row_index, column_index};
}

Result<double> TabTable::number(std::int64_t row, std::string_view column) const {
  const auto place = TRY(find(row, column));
  const std::string_view written = cell(place.row, place.column);
  if (written.empty()) {
    return Error{ErrorCode::TableCellEmpty,
                 fmt::format("table {} is blank in {}", header_.name, place_of(row, column))};
  }
  if (const auto value = to_decimal(written)) return *value;
  return Error{ErrorCode::NumberMalformed,
               fmt::format("table {} has no number in {}: '{}'", header_.name,
                           place_of(row, column), written)};
}

Result<std::string_view> TabTable::text(std::int64_t row, std::string_view column) const {
  const auto place = TRY(find(row, column));
  return cell(place.row, place.column);
}

Result<void> TabTable::set_number(std::int64_t row, std::string_view column, double value) {
  const auto place = TRY(find(row, column));
  if (!std::isfinite(value)) {
    return Error{ErrorCode::NumberOutOfRange,
                 fmt::format("{} accepts only finite numbers", place_of(row, column))};
  }
  const TabColumn& target = columns_[place.column];
  return set_text(row, column,
                  target.decimals ? fmt::format("{:.{}f}", value, *target.decimals)
                                  : shortest(value, target.width));
}

Result<void> TabTable::set_text(std::int64_t row, std::string_view column, std::string_view value) {
  const auto place = TRY(find(row, column));
  if (place.column == 0) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("column {} numbers the rows and cannot be written", column)};
  }
  const TabColumn& target = columns_[place.column];
  const std::string_view written = trim(value);
  if (count_characters(written) > std::max(target.width, count_characters(target.name))) {
    return Error{ErrorCode::TableCellTooLong,
                 fmt::format("'{}' is longer than the {} characters of {} in table {}", written,
                             target.width, place_of(row, column), header_.name)};
  }
  if (std::ranges::any_of(written, [](char c) { return static_cast<unsigned char>(c) < ' '; })) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("the text for {} has a control character", place_of(row, column))};
  }
  const bool is_numeric = std::ranges::find(kNumericTypes, target.type) != kNumericTypes.end();
  if (is_numeric && !written.empty() && !to_decimal(written)) {
    return Error{ErrorCode::NumberMalformed,
                 fmt::format("table {} takes a number in {}, not '{}'", header_.name,
                             place_of(row, column), written)};
  }
  changed_[place] = written;
  return {};
}

bool operator==(const TabTable& left, const TabTable& right) {
  const auto shape = [](const TabTable& table) {
    return std::tuple(table.header_, table.columns_, table.row_count());
  };
  if (shape(left) != shape(right)) return false;
  for (std::size_t row = 0; row < left.row_count(); ++row)
    for (std::size_t column = 0; column < left.columns_.size(); ++column)
      if (left.cell(row, column) != right.cell(row, column)) return false;
  return true;
}

std::string write_tab(const TabTable& table) {
  std::string out = begin_line(table.header()) + "\n" + write_description(table);
  const auto& columns = table.columns();
  std::string line;
  for (const TabColumn& column : columns) append_cell(line, column.name, column);
  append_line(out, std::move(line));
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    line.clear();
    for (std::size_t i = 0; i < columns.size(); ++i)
      append_cell(line, table.cell(row, i), columns[i]);
    append_line(out, std::move(line));
  }
  return out + "[END]\n";
}

}  // namespace fitgauge::tabfile

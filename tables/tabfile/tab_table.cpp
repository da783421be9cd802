#include "tables/tabfile/tab_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/number.hpp"
#include "base/text.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::tabfile {
namespace {

/// The whole of `text` as a number, a leading plus sign allowed.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  return read_number<Number>(text);
}

/// A number with `,` or `.` as its decimal mark.
std::optional<double> to_decimal(std::string_view text) {
  std::string pointed(text);
  if (pointed.find('.') == std::string::npos) {
    const std::size_t mark = pointed.find(',');
    if (mark != std::string::npos) pointed[mark] = '.';
  }
  return to_number<double>(pointed);
}

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

}  // namespace

TabTable::TabTable(TabHeader header, std::vector<TabColumn> columns)
    : header_(std::move(header)), columns_(std::move(columns)) {
  assert(!columns_.empty());
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_by_name_.emplace(columns_[i].name, i);
}

std::string_view TabTable::cell(std::size_t row, std::size_t column) const {
  const auto& cells = rows_[row];
  return column < cells.size() ? std::string_view(cells[column]) : std::string_view();
}

Result<void> TabTable::append_row(std::vector<std::string> cells) {
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  if (cells.size() > columns_.size()) {
    return Error{ErrorCode::TableFileMalformed, "a row has more cells than the table has columns"};
  }
  const auto number = cells.empty() ? std::nullopt : to_number<std::int64_t>(cells.front());
  if (number && !rows_by_number_.emplace(*number, rows_.size()).second) {
    return Error{ErrorCode::TableFileMalformed, fmt::format("row {} is there twice", *number)};
  }
  rows_.push_back(std::move(cells));
  return {};
}

Result<std::size_t> TabTable::find_column(std::string_view name) const {
  const auto found = columns_by_name_.find(name);
  if (found != columns_by_name_.end()) return found->second;
  return Error{ErrorCode::TableColumnMissing,
               fmt::format("table {} has no column '{}'", header_.name, name)};
}

Result<std::size_t> TabTable::find_row(std::int64_t number) const {
  const auto found = rows_by_number_.find(number);
  if (found != rows_by_number_.end()) return found->second;
  return Error{ErrorCode::TableRowMissing,
               fmt::format("table {} has no row {} in its column {}", header_.name, number,
                           columns_.front().name)};
}

Result<TabTable::Place> TabTable::find(std::int64_t row, std::string_view column) const {
  const auto row_index = find_row(row);
  if (!row_index) return row_index.error();
  const auto column_index = find_column(column);
  if (!column_index) return column_index.error();
  return Place{*row_index, *column_index};
}

Result<double> TabTable::number(std::int64_t row, std::string_view column) const {
  const auto place = find(row, column);
  if (!place) return place.error();
  const std::string_view written = cell(place->row, place->column);
  if (written.empty()) {
    return Error{ErrorCode::TableCellEmpty,
                 fmt::format("table {} is blank in {}", header_.name, place_of(row, column))};
  }
  const auto value = to_decimal(written);
  if (value && std::isfinite(*value)) return *value;
  return Error{ErrorCode::NumberMalformed,
               fmt::format("table {} has no number in {}: '{}'", header_.name,
                           place_of(row, column), written)};
}

Result<std::string_view> TabTable::text(std::int64_t row, std::string_view column) const {
  const auto place = find(row, column);
  if (!place) return place.error();
  return cell(place->row, place->column);
}

Result<void> TabTable::set_number(std::int64_t row, std::string_view column, double value) {
  const auto place = find(row, column);
  if (!place) return place.error();
  if (!std::isfinite(value)) {
    return Error{ErrorCode::NumberOutOfRange,
                 fmt::format("{} accepts only finite numbers", place_of(row, column))};
  }
  const TabColumn& target = columns_[place->column];
  return set_text(row, column,
                  target.decimals ? fmt::format("{:.{}f}", value, *target.decimals)
                                  : shortest(value, target.width));
}

Result<void> TabTable::set_text(std::int64_t row, std::string_view column, std::string_view value) {
  const auto place = find(row, column);
  if (!place) return place.error();
  if (place->column == 0) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("column {} numbers the rows and cannot be written", column)};
  }
  const TabColumn& target = columns_[place->column];
  const std::string_view written = trim(value);
  if (count_characters(written) > std::max(target.width, count_characters(target.name))) {
    return Error{ErrorCode::TableCellTooLong,
                 fmt::format("'{}' is longer than the {} characters of {} in table {}", written,
                             target.width, place_of(row, column), header_.name)};
  }
  auto& cells = rows_[place->row];
  if (cells.size() <= place->column) cells.resize(place->column + 1);
  cells[place->column] = written;
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return {};
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

#include "tables/tabfile/tab_table.hpp"

#include "base/number.hpp"
#include "base/text.hpp"

namespace fitgauge::tabfile {
namespace {

/// A width or count of decimals; 0 for other texts: the column line decides anyway.
template <class Number>
Number small_number(std::string_view text) {
  constexpr Number kLargest = 999;
  const Number value = read_number<Number>(text).value_or(0);
  return value <= kLargest ? value : 0;
}

std::string_view unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    return text.substr(1, text.size() - 2);
  }
  return text;
}

/// The end of a value of TableDescription: a quoted text, or up to a comma or parenthesis.
std::size_t value_end(std::string_view text) {
  if (text.starts_with('"')) {
    const std::size_t quote = text.find('"', 1);
    return quote == std::string_view::npos ? text.size() : quote + 1;
  }
  return std::min(text.find_first_of(",)]\r\n"), text.size());
}

/// The word that ends before `end`.
std::string_view key_before(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 && is_ascii_letter(text[begin - 1])) --begin;
  return text.substr(begin, end - begin);
}

}  // namespace

ColumnDescriptions read_struct_block(const std::vector<std::string_view>& lines) {
  ColumnDescriptions columns;
  TabColumn* column = nullptr;
  for (const std::string_view line : lines) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = trim(line.substr(0, equals));
    const std::string_view value = trim(line.substr(equals + 1));
    if (key == "NAME") {
      if (columns.size() == kMostColumns) return columns;
      column = &columns[std::string(value)];
      column->name = value;
    } else if (column == nullptr) {
      continue;
    } else if (key == "TYPE") {
      column->type = value;
    } else if (key == "WIDTH") {
      column->width = small_number<std::size_t>(value);
    } else if (key == "DEC") {
      column->decimals = small_number<int>(value);
    }
  }
  return columns;
}

ColumnDescriptions read_table_description(std::string_view text) {
  constexpr std::string_view kAssign = ":=";
  ColumnDescriptions columns;
  TabColumn* column = nullptr;
  while (true) {
    const std::size_t assign = text.find(kAssign);
    if (assign == std::string_view::npos) return columns;
    const std::string_view key = key_before(text, assign);
    text = trim(text.substr(assign + kAssign.size()));
    const std::size_t end = value_end(text);
    const std::string_view value = unquoted(trim(text.substr(0, end)));
    if (key == "columns") continue;  // the list, not a value
    text.remove_prefix(end);
    if (key == "key") {
      if (columns.size() == kMostColumns) return columns;
      column = &columns[std::string(value)];
      column->name = value;
      column->type = "FLOAT";
    } else if (column == nullptr) {
      continue;
    } else if (key == "width") {
      column->width = small_number<std::size_t>(value);
    } else if (key == "decimals") {
      column->decimals = small_number<int>(value);
    } else if (key == "unit") {
      column->type = value;
    }
  }
}

namespace {

/// Returns whether a column has data that its name and place do not define. The width of the last
/// column does not count.
bool is_described(const TabTable& table, const TabColumn& column) {
  const bool is_last = &column == &table.columns().back();
  return !column.type.empty() || column.decimals || is_last;
}

}  // namespace

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

}  // namespace fitgauge::tabfile

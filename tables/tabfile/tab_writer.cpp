#include "tables/tabfile/tab_writer.hpp"

#include <algorithm>

#include "tables/tabfile/characters.hpp"
#include "tables/tabfile/column_description.hpp"

namespace fitgauge::tabfile {
namespace {

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

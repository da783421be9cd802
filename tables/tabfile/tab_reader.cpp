#include "tables/tabfile/tab_table.hpp"

#include "tables/tabfile/characters.hpp"

namespace fitgauge::tabfile {
namespace {

constexpr std::size_t kMostCells = 1'000'000;
constexpr std::size_t kMostLines = 1'000'000;
constexpr std::string_view kBegin = "BEGIN";
/// Width of the last column if nothing defines it: the longest text of the control.
constexpr std::size_t kWidestCell = 255;

std::vector<std::string_view> lines_of(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<std::string_view> lines;
  const auto ends = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  lines.reserve(std::min(ends, kMostLines) + 1);
  while (!text.empty() && lines.size() <= kMostLines) {
    std::string_view line = take_field(text, '\n');
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
  }
  return lines;
}

bool is_control_character(char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; }

bool is_end(std::string_view line) { return ascii_iequals(trim(line), "[END]"); }

/// Returns whether the character would end a name or type in a description.
bool ends_a_word(char c) {
  return c == '"' || c == '(' || c == ')' || c == ',' || static_cast<unsigned char>(c) < ' ';
}

/// The next word of `text`, which is shortened by it.
std::string_view take_word(std::string_view& text) {
  text = trim(text);
  const std::string_view word = take_field(text, ' ');
  text = trim(text);
  return word;
}

/// The fields after BEGIN: name, suffix (a blank may precede its dot), unit, version.
TabHeader read_begin_line(std::string_view text) {
  TabHeader header;
  header.name = take_word(text);
  if (text.starts_with('.')) header.name += " " + std::string(take_word(text));
  std::string_view rest = text;
  const std::string_view unit = take_word(rest);
  if (ascii_iequals(unit, "MM") || ascii_iequals(unit, "INCH")) {
    header.unit = ascii_upper(unit);
    text = rest;
  }
  header.version = text;
  return header;
}

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

/// The description of columns in a file, by name, before the line of their names.
using ColumnDescriptions = std::map<std::string, TabColumn, std::less<>>;

/// Reads the lines between #STRUCTBEGIN and #STRUCTEND; texts for dialogs are passed over.
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

/// Reads the text in the parentheses of TableDescription.
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

/// A column of the column line: the begin of its cells and of the next column's cells.
struct ColumnPlace {
  std::size_t begin;  ///< in characters
  std::size_t width;  ///< in characters, with the blank between columns; npos for the last one
};

/// Reads one file, line by line.
class Reader {
 public:
  Reader(std::string_view text, Allowance& allowance)
      : lines_(lines_of(text)), allowance_(allowance) {}

  Result<TabTable> read() {
    if (lines_.size() > kMostLines) {
      return malformed(kMostLines, "a table has at most a million lines");
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (std::ranges::any_of(lines_[i], is_control_character)) {
        return malformed(i, "a control character");
      }
    }
    if (lines_.empty() || !ascii_iequals(lines_[0].substr(0, kBegin.size()), kBegin)) {
      return malformed(0, "a table file begins with BEGIN and its name");
    }
    TabHeader header = read_begin_line(lines_[0].substr(kBegin.size()));
    if (header.name.empty()) return malformed(0, "BEGIN is not followed by the table's name");
    next_ = 1;
    const auto descriptions = TRY(read_descriptions(header));
    auto columns = TRY(read_column_line(descriptions));
    TabTable table(std::move(header), std::move(columns));
    TRY(read_rows(table));
    return table;
  }

 private:
  Error malformed(std::size_t line, std::string_view what) const {
    return {ErrorCode::TableFileMalformed, fmt::format("line {}: {}", line + 1, what),
            fmt::format("line {}", line + 1)};
  }

  void skip_comments() {
    while (next_ < lines_.size() &&
           (trim(lines_[next_]).empty() || trim(lines_[next_]).starts_with(';'))) {
      ++next_;
    }
  }

  Result<ColumnDescriptions> read_descriptions(TabHeader& header) {
    skip_comments();
    const std::size_t first = next_;
    const std::string_view line = first < lines_.size() ? trim(lines_[first]) : std::string_view();
    header.form = HeaderForm::None;
    if (line.starts_with("#STRUCTBEGIN")) {
      header.form = HeaderForm::StructBlock;
      const auto end = take_until([](std::string_view l) { return l.starts_with("#STRUCTEND"); });
      if (!end) return malformed(first, "#STRUCTBEGIN has no #STRUCTEND");
      return read_struct_block({lines_.begin() + offset(first + 1), lines_.begin() + offset(*end)});
    }
    if (line.starts_with("TableDescription")) {
      header.form = HeaderForm::TableDescription;
      // Its line ends with "(", every inner parenthesis closes on its line or deeper.
      int depth = 0;
      const auto end = take_until([&](std::string_view l) {
        depth += static_cast<int>(std::ranges::count(l, '('));
        depth -= static_cast<int>(std::ranges::count(l, ')'));
        return depth == 0;
      });
      if (!end) return malformed(first, "TableDescription is not closed");
      const char* const begin = lines_[first].data();
      const char* const last = lines_[*end].data() + lines_[*end].size();
      return read_table_description({begin, static_cast<std::size_t>(last - begin)});
    }
    return ColumnDescriptions();
  }

  /// Reads lines up to and including the first that `is_last`, and returns its index.
  template <class Predicate>
  std::optional<std::size_t> take_until(Predicate is_last) {
    while (next_ < lines_.size()) {
      if (is_last(trim(lines_[next_++]))) return next_ - 1;
    }
    return std::nullopt;
  }

  Result<std::vector<TabColumn>> read_column_line(const ColumnDescriptions& descriptions) {
    skip_comments();
    if (next_ >= lines_.size() || is_end(lines_[next_])) {
      return malformed(next_, "the line with the names of the columns is missing");
    }
    const std::string_view line = lines_[next_];
    std::vector<TabColumn> columns;
    std::size_t counted = 0;  // bytes of the line whose characters are counted
    std::size_t characters = 0;
    std::size_t at = line.find_first_not_of(' ');
    while (at != std::string_view::npos) {
      if (columns.size() == kMostColumns) {
        return malformed(next_, "a table has at most 4096 columns");
      }
      const std::size_t end = std::min(line.find(' ', at), line.size());
      const std::string name(line.substr(at, end - at));
      const auto described = descriptions.find(name);
      columns.push_back(described == descriptions.end() ? TabColumn{.name = name}
                                                        : described->second);
      if (!names_.insert(name).second) {
        return malformed(next_, "column " + name + " is repeated");
      }
      const std::string written = name + columns.back().type;
      if (std::ranges::any_of(written, ends_a_word)) {
        return malformed(next_, "name or type of column " + name + " is not a word");
      }
      characters += count_characters(line.substr(counted, at - counted));
      counted = at;
      places_.push_back({characters, std::string_view::npos});
      at = line.find_first_not_of(' ', end);
    }
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      places_[i].width = places_[i + 1].begin - places_[i].begin;
      columns[i].width = places_[i].width - 1;
    }
    std::size_t& last = columns.back().width;
    if (last == 0) last = kWidestCell;
    last = std::max(last, count_characters(columns.back().name));
    ++next_;
    return columns;
  }

  Result<void> read_rows(TabTable& table) {
    std::size_t cells = 0;
    for (; next_ < lines_.size(); ++next_) {
      const std::string_view line = lines_[next_];
      if (is_end(line)) return read_nothing_more();
      if (trim(line).empty()) continue;
      const auto row = TRY(cut(line));
      constexpr std::size_t kBetweenLooks = 256;
      if (next_ % kBetweenLooks == 0 && allowance_.is_spent()) {
        return malformed(next_, "the table is too large to be read here");
      }
      cells += row.size();
      if (cells > kMostCells) return malformed(next_, "a table has at most a million cells");
      if (auto appended = table.append_row(row); !appended) {
        return malformed(next_, appended.error().message);
      }
    }
    return malformed(lines_.size() - 1, "the file ends without [END]: it may be cut off");
  }

  Result<void> read_nothing_more() const {
    for (std::size_t i = next_ + 1; i < lines_.size(); ++i) {
      if (!trim(lines_[i]).empty()) return malformed(i, "text after [END]");
    }
    return {};
  }

  Result<std::vector<std::string_view>> cut(std::string_view line) const {
    std::vector<std::string_view> cells;
    std::size_t begin = skip_characters(line, 0, places_.front().begin);
    if (!trim(line.substr(0, begin)).empty()) {
      return malformed(next_, "text before the first column");
    }
    for (std::size_t i = 0; i < places_.size() && begin < line.size(); ++i) {
      const std::size_t width = places_[i].width;
      const std::size_t end =
          width == std::string_view::npos ? line.size() : skip_characters(line, begin, width);
      const std::string_view cell = line.substr(begin, end - begin);
      // The last character of a column is the blank before the next one.
      if (!cell.ends_with(' ') && count_characters(cell) == width) {
        return malformed(next_, fmt::format("the cell of column {} runs into the next one", i + 1));
      }
      cells.push_back(trim(cell));
      begin = end;
    }
    return cells;
  }

  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  std::vector<std::string_view> lines_;
  Allowance& allowance_;
  std::size_t next_ = 0;
  std::vector<ColumnPlace> places_;
  std::set<std::string> names_;
};

}  // namespace

Result<TabTable> read_tab_file(std::string_view bytes, Allowance& allowance) {
  return is_utf8(bytes) ? Reader(bytes, allowance).read()
                        : Reader(utf8_from_windows1252(bytes), allowance).read();
}

}  // namespace fitgauge::tabfile

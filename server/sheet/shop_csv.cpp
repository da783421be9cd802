#include "sheet/shop_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "sheet/csv_cell.hpp"
#include "sheet/exported_record.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::size_t kMostCells = 1000;
constexpr std::string_view kDate = "date";
constexpr std::string_view kTime = "time";
constexpr std::string_view kMeasuredAt = "measured_at";

/// Columns that a list of /v1/measurements has as CSV, and no other table has all of.
constexpr std::array<std::string_view, 5> kOfExport = {"id", "source", "basis", "verdict",
                                                       "upper_deviation_um"};

Error at_line(ErrorCode code, std::size_t line, std::string_view what) {
  return {code, fmt::format("line {} {}", line, what), fmt::format("line {}", line)};
}

/// Without blanks, tabs and no-break spaces around it.
std::string_view bare(std::string_view text) {
  constexpr std::string_view kNoBreak = "\xC2\xA0";
  for (;;) {
    text = trim(text);
    if (text.starts_with(kNoBreak)) {
      text.remove_prefix(kNoBreak.size());
    } else if (text.ends_with(kNoBreak)) {
      text.remove_suffix(kNoBreak.size());
    } else {
      return text;
    }
  }
}

/// One line of the table, which may span several of the text.
struct Record {
  std::size_t line = 0;
  std::size_t lines = 0;  ///< of the text
  std::vector<std::string> cells{};

  bool is_empty() const {
    return std::all_of(cells.begin(), cells.end(),
                       [](const std::string& cell) { return bare(cell).empty(); });
  }
};

/// Takes records from the front of a text.
class RecordReader {
 public:
  RecordReader(std::string_view text, std::size_t line) : rest_(text), line_(line) {}

  void set_separator(char separator) { separator_ = separator; }
  bool is_at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

  /// @errors CsvMalformed
  Result<Record> next() {
    Record record{.line = line_};
    for (;;) {
      if (record.cells.size() == kMostCells) {
        return at_line(ErrorCode::CsvMalformed, line_,
                       fmt::format("has more than {} cells", kMostCells));
      }
      std::string cell;
      if (auto read = read_cell(cell, record); !read) return read.error();
      record.cells.push_back(std::move(cell));
      if (rest_.empty() || rest_.front() != separator_) break;
      rest_.remove_prefix(1);
    }
    take_line_end(record);
    line_ += record.lines;
    return record;
  }

 private:
  Result<void> read_cell(std::string& cell, Record& record) {
    const std::size_t blanks = std::min(rest_.find_first_not_of(' '), rest_.size());
    if (!rest_.substr(blanks).starts_with('"')) {
      const char stops[] = {separator_, '\r', '\n'};
      const std::size_t end =
          std::min(rest_.find_first_of(std::string_view(stops, sizeof stops)), rest_.size());
      cell = rest_.substr(0, end);
      rest_.remove_prefix(end);
      return {};
    }
    rest_.remove_prefix(blanks + 1);
    for (;;) {
      const std::size_t end = rest_.find('"');
      if (end == std::string_view::npos) {
        return at_line(ErrorCode::CsvMalformed, record.line, "has a quote that is not closed");
      }
      for (const char c : rest_.substr(0, end)) record.lines += c == '\n' ? 1 : 0;
      cell += rest_.substr(0, end);
      rest_.remove_prefix(end + 1);
      if (!rest_.starts_with('"')) break;
      cell += '"';
      rest_.remove_prefix(1);
    }
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
    if (rest_.empty() || rest_.front() == separator_ || rest_.front() == '\r' ||
        rest_.front() == '\n') {
      return {};
    }
    return at_line(ErrorCode::CsvMalformed, record.line, "has text after a closing quote");
  }

  void take_line_end(Record& record) {
    if (rest_.empty()) return;
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    ++record.lines;
  }

  std::string_view rest_;
  std::size_t line_;
  char separator_ = ';';
};

/// `sep=;` as a spreadsheet writes it before the header.
std::optional<char> separator_line(std::string_view line) {
  if (line.size() == 5 && ascii_iequals(line.substr(0, 4), "sep=")) return line[4];
  return std::nullopt;
}

char separator_of(std::string_view header) {
  for (const char separator : {'\t', ';'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

class Converter {
 public:
  Converter(const ShopCsvOptions& options, std::span<const std::string_view> fields)
      : options_(options), fields_(fields) {}

  Result<std::string> convert(std::string_view text);

 private:
  /// The field of a column: empty where it is left out, as it is where nobody knows it.
  std::string field_of(std::string_view column) const;
  void read_header(const Record& record);
  std::string field_of_export(std::string_view column) const;
  /// @errors CsvMalformed: it is not of a gauge.
  Result<void> check_export(const Record& record);
  Result<void> convert_row(const Record& record);
  Result<std::string> measured_at(const Record& record, std::string_view text) const;
  const std::string* cell(const Record& record, std::string_view field) const;
  void append_line_ends(std::size_t count) { out_.append(count, '\n'); }

  const ShopCsvOptions& options_;
  const std::span<const std::string_view> fields_;
  std::vector<std::string> header_;   ///< fields; empty: left out
  bool has_clock_ = false;            ///< date and time in columns of their own
  std::optional<std::size_t> basis_;  ///< of an export: the columns that decide
  std::optional<std::size_t> source_;
  bool has_drawn_limits_ = true;  ///< the row of an export that is converted
  std::string out_;
};

std::string Converter::field_of(std::string_view column) const {
  const std::string_view name = bare(column);
  for (const auto& [from, to] : options_.columns) {
    if (ascii_iequals(bare(from), name)) return to;
  }
  for (const std::string_view field : fields_) {
    if (ascii_iequals(field, name)) return std::string(field);
  }
  return options_.leaves_out_others ? std::string() : std::string(name);
}

std::string Converter::field_of_export(std::string_view column) const {
  for (const auto& [of_export, field] : kLimitsOfExport) {
    if (column == of_export) return std::string(field);
  }
  const bool is_field = std::find(fields_.begin(), fields_.end(), column) != fields_.end();
  return is_field ? std::string(column) : std::string();
}

Result<void> Converter::check_export(const Record& record) {
  if (!basis_) return {};
  has_drawn_limits_ = record.cells[*basis_] == "explicit";
  if (record.cells[*source_] == "gauge") return {};
  return at_line(ErrorCode::CsvMalformed, record.line, kOfSimulation);
}

void Converter::read_header(const Record& record) {
  const auto place = [&record](std::string_view name) -> std::optional<std::size_t> {
    const auto found = std::find(record.cells.begin(), record.cells.end(), name);
    if (found == record.cells.end()) return std::nullopt;
    return static_cast<std::size_t>(found - record.cells.begin());
  };
  const bool is_export = std::all_of(kOfExport.begin(), kOfExport.end(),
                                     [&](std::string_view name) { return place(name); });
  if (is_export) {
    basis_ = place("basis");
    source_ = place("source");
  }
  for (const std::string& column : record.cells) {
    header_.push_back(is_export ? field_of_export(column) : field_of(column));
  }
  has_clock_ = std::find(header_.begin(), header_.end(), kDate) != header_.end();
  bool is_first = true;
  const auto append = [&](std::string_view name) {
    if (!is_first) out_ += ';';
    is_first = false;
    append_csv_cell(out_, name, CsvSeparator::Semicolon);
  };
  for (const std::string& name : header_) {
    if (name.empty() || name == kDate || name == kTime) continue;
    append(name);
  }
  if (has_clock_) append(kMeasuredAt);
  for (const auto& [field, value] : options_.constants) {
    if (std::find(header_.begin(), header_.end(), field) == header_.end()) append(field);
  }
  append_line_ends(std::max<std::size_t>(record.lines, 1));
}

const std::string* Converter::cell(const Record& record, std::string_view field) const {
  const auto found = std::find(header_.begin(), header_.end(), field);
  return found == header_.end() ? nullptr
                                : &record.cells[static_cast<std::size_t>(found - header_.begin())];
}

Result<std::string> Converter::measured_at(const Record& record, std::string_view text) const {
  text = bare(text);
  const auto wall = parse_wall_time(text);
  if (!wall) return std::string(text);  // with an offset, or wrong: the reader of fields says so
  if (!options_.zone) {
    return at_line(ErrorCode::TimeMalformed, record.line,
                   fmt::format("has the time '{}' without an offset: name the time zone of its "
                               "clock (time_zone)",
                               first_characters(text, 40)));
  }
  const auto instant = options_.zone->instant(*wall);
  if (!instant) {
    return at_line(ErrorCode::TimeMalformed, record.line,
                   fmt::format("has the time '{}', and {}", first_characters(text, 40),
                               instant.error().message));
  }
  return format_rfc3339(*instant);
}

Result<void> Converter::convert_row(const Record& record) {
  if (record.is_empty()) {
    append_line_ends(record.lines);
    return {};
  }
  if (record.cells.size() != header_.size()) {
    return at_line(
        ErrorCode::CsvMalformed, record.line,
        fmt::format("has {} cells and the header {}", record.cells.size(), header_.size()));
  }
  if (const auto checked = check_export(record); !checked) return checked.error();
  bool is_first = true;
  std::size_t inside = 0;  // line ends in cells that are kept
  const auto append = [&](std::string_view value) {
    if (!is_first) out_ += ';';
    is_first = false;
    inside += static_cast<std::size_t>(std::count(value.begin(), value.end(), '\n'));
    append_csv_cell(out_, value, CsvSeparator::Semicolon);
  };
  for (std::size_t i = 0; i < header_.size(); ++i) {
    const std::string& field = header_[i];
    std::string_view value = bare(record.cells[i]);
    const bool is_limit =
        std::any_of(kLimitsOfExport.begin(), kLimitsOfExport.end(),
                    [&field](const auto& limit) { return limit.second == field; });
    if (is_limit && !has_drawn_limits_) value = {};
    if (field.empty() || field == kDate || field == kTime) continue;
    if (field != kMeasuredAt || value.empty()) {
      append(value);
      continue;
    }
    const auto at = measured_at(record, value);
    if (!at) return at.error();
    append(*at);
  }
  if (has_clock_) {
    const std::string* const time = cell(record, kTime);
    const auto at = measured_at(
        record, fmt::format("{} {}", bare(*cell(record, kDate)), time ? bare(*time) : "00:00"));
    if (!at) return at.error();
    append(*at);
  }
  for (const auto& [field, value] : options_.constants) {
    if (std::find(header_.begin(), header_.end(), field) == header_.end()) append(value);
  }
  append_line_ends(record.lines - std::min(record.lines, inside));
  return {};
}

Result<std::string> Converter::convert(std::string_view text) {
  std::size_t line = 1;
  std::optional<char> separator;
  std::size_t before = 0;
  // What stands before the header: empty lines, and what a spreadsheet says of its cells.
  for (;;) {
    const std::string_view first = text.substr(0, text.find_first_of("\r\n"));
    const auto said = separator_line(trim(first));
    if (text.empty() || (!said && !bare(first).empty())) break;
    if (said) separator = said;
    text.remove_prefix(first.size());
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
    ++line;
    ++before;
  }
  if (text.empty()) {
    return at_line(ErrorCode::CsvMalformed, line, "should have the names of the columns");
  }
  RecordReader records(text, line);
  records.set_separator(
      separator.value_or(separator_of(text.substr(0, text.find_first_of("\r\n")))));
  const auto header = records.next();
  if (!header) return header.error();
  read_header(*header);
  append_line_ends(before);  // behind the header, so that the lines below keep their numbers
  while (!records.is_at_end()) {
    const auto record = records.next();
    if (!record) return record.error();
    if (const auto converted = convert_row(*record); !converted) return converted.error();
  }
  return std::move(out_);
}

}  // namespace

Result<std::string> shop_csv(std::string_view bytes, const ShopCsvOptions& options,
                             std::span<const std::string_view> fields) {
  const auto text = to_utf8(bytes, options.encoding);
  if (!text) return text.error();
  return Converter(options, fields).convert(*text);
}

}  // namespace fitgauge::sheet

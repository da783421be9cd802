#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::string_view kDate = "date";
constexpr std::string_view kTime = "time";
constexpr std::string_view kMeasuredAt = "measured_at";

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

}  // namespace

std::string ShopRows::field_of(std::string_view column) const {
  const std::string_view name = bare(column);
  for (const auto& [from, to] : options_.columns) {
    if (ascii_iequals(bare(from), name)) return to;
  }
  for (const std::string_view field : kMeasurementFields) {
    if (ascii_iequals(field, name)) return std::string(field);
  }
  return options_.leaves_out_others ? std::string() : std::string(name);
}

Result<void> ShopRows::read_export(const Record& record) {
  if (members_.empty()) return {};
  const auto text_of = [&](std::string_view member) -> std::string_view {
    const auto found = std::ranges::find(members_, member);
    if (found == members_.end()) return {};
    return bare(record.cells[static_cast<std::size_t>(found - members_.begin())]);
  };
  auto row = read_exported(text_of, options_.limits_of);
  if (!row) return at_table_line(row.error().code, record.line, row.error().message);
  exported_ = *std::move(row);
  return {};
}

std::string ShopRows::header_of(const Record& record) {
  const bool is_export = std::ranges::all_of(kOfExport, [&](std::string_view name) {
    return std::ranges::find(record.cells, name) != record.cells.end();
  });
  if (is_export) members_ = record.cells;
  for (const std::string& column : record.cells) {
    fields_.push_back(is_export ? std::string(field_of_export(column, ExportedRow()))
                                : field_of(column));
  }
  has_clock_ = std::ranges::find(fields_, kDate) != fields_.end();
  std::string header;
  auto append = [&header, is_first = true](std::string_view name) mutable {
    if (!std::exchange(is_first, false)) header += ';';
    append_csv_cell(header, name, CsvSeparator::Semicolon);
  };
  for (const std::string& name : fields_) {
    if (name.empty() || name == kDate || name == kTime) continue;
    append(name);
  }
  if (has_clock_) append(kMeasuredAt);
  if (is_export) append(kDesignation);
  for (const auto& [field, value] : options_.constants) {
    if (std::ranges::find(fields_, field) == fields_.end()) append(field);
  }
  header.append(std::max<std::size_t>(record.lines, 1), '\n');
  return header;
}

const std::string* ShopRows::cell(const Record& record, std::string_view field) const {
  const auto found = std::ranges::find(fields_, field);
  return found == fields_.end() ? nullptr
                                : &record.cells[static_cast<std::size_t>(found - fields_.begin())];
}

Result<std::string> ShopRows::measured_at(const Record& record, std::string_view text) const {
  auto instant = instant_text(bare(text), options_.zone);  // the reader of fields checks others
  if (!instant)
    return at_table_line(ErrorCode::TimeMalformed, record.line, instant.error().message);
  return instant;
}

Result<void> ShopRows::convert_row(const Record& record, std::string& rows) {
  if (record.is_empty()) {
    rows.append(record.lines, '\n');
    return {};
  }
  if (record.cells.size() != fields_.size()) {
    return at_table_line(
        ErrorCode::CsvMalformed, record.line,
        fmt::format("has {} cells, and the header has {}", record.cells.size(), fields_.size()));
  }
  TRY(read_export(record));
  bool is_first = true;
  std::size_t inside = 0;  // line ends in cells that are kept
  const auto append = [&](std::string_view value) {
    if (!std::exchange(is_first, false)) rows += ';';
    inside += static_cast<std::size_t>(std::ranges::count(value, '\n'));
    append_csv_cell(rows, value, CsvSeparator::Semicolon);
  };
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const std::string& field = fields_[i];
    std::string_view value = bare(record.cells[i]);
    if (!members_.empty() && field_of_export(members_[i], exported_).empty()) value = {};
    if (field.empty() || field == kDate || field == kTime) continue;
    if (field != kMeasuredAt || value.empty()) {
      append(value);
      continue;
    }
    const auto at = TRY(measured_at(record, value));
    append(at);
  }
  if (has_clock_) {
    const std::string* const time = cell(record, kTime);
    const auto at = TRY(measured_at(
        record, fmt::format("{} {}", bare(*cell(record, kDate)), time ? bare(*time) : "00:00")));
    append(at);
  }
  if (!members_.empty()) append(exported_.designation);
  for (const auto& [field, value] : options_.constants) {
    if (std::ranges::find(fields_, field) == fields_.end()) append(value);
  }
  rows.append(record.lines - std::min(record.lines, inside), '\n');
  return {};
}

Result<void> ShopRows::read_header() {
  std::optional<char> separator;
  std::size_t before = 0;
  std::string_view first;
  // Lines before the header: empty lines, and the description of a spreadsheet's cells.
  for (;; ++before) {
    first = TRY(records_.peek_line());
    const auto said = separator_line(trim(first));
    if (records_.is_at_end() || (!said && !bare(first).empty())) break;
    if (said) separator = said;
    records_.pass_line(first);
  }
  if (records_.is_at_end())
    return at_table_line(ErrorCode::CsvMalformed, records_.line(), "must have the column names");
  records_.set_separator(separator.value_or(separator_of(first)));
  TRY(records_.next(record_));
  // After the header, so that the next lines keep their numbers.
  header_ = header_of(record_) + std::string(before, '\n');
  return {};
}

Result<bool> ShopRows::append(std::string& rows) {
  const auto more = records_.next(record_);
  if (!more || !*more) return more;
  TRY(convert_row(record_, rows));
  return true;
}

Result<ShopRows> ShopRows::open(const Read& first, Read again, ShopCsvOptions options) {
  auto input = TRY(Utf8Input::open(first, std::move(again), options.encoding));
  ShopRows rows(std::move(input), std::move(options));
  TRY(rows.read_header());
  return rows;
}

}  // namespace fitgauge::sheet

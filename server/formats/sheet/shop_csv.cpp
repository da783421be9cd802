#include "formats/sheet/shop_csv.hpp"

#include "base/csv.hpp"
#include "base/text.hpp"
#include "formats/sheet/record_reader.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::string_view kDate = "date";
constexpr std::string_view kTime = "time";
constexpr std::string_view kMeasuredAt = "measured_at";

/// Columns that a list of /v1/measurements has as CSV, and no other table has all of.
constexpr std::array<std::string_view, 5> kOfExport = {"id", "source", "basis", "verdict",
                                                       "upper_deviation_um"};

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

class ShopRows::Converter {
 public:
  Converter(Utf8Input input, ShopCsvOptions options)
      : options_(std::move(options)), records_(std::move(input)) {}

  /// @errors CsvMalformed, TextEncoding
  Result<std::string> read_header();
  Result<bool> append(std::string& rows);

 private:
  /// The field of a column: empty if it is left out or unknown.
  std::string field_of(std::string_view column) const;
  std::string header_of(const Record& record);
  /// @errors CsvMalformed: it is not of a gauge.
  Result<void> check_export(const Record& record);
  Result<void> convert_row(const Record& record, std::string& rows);
  Result<std::string> measured_at(const Record& record, std::string_view text) const;
  const std::string* cell(const Record& record, std::string_view field) const;

  const ShopCsvOptions options_;
  RecordReader records_;
  Record record_;
  std::vector<std::string> header_;   ///< fields; empty: left out
  bool has_clock_ = false;            ///< date and time are in separate columns
  std::optional<std::size_t> basis_;  ///< of an export: the columns that decide
  std::optional<std::size_t> source_;
  bool has_drawn_limits_ = true;  ///< the row of an export that is converted
};

std::string ShopRows::Converter::field_of(std::string_view column) const {
  const std::string_view name = bare(column);
  for (const auto& [from, to] : options_.columns) {
    if (ascii_iequals(bare(from), name)) return to;
  }
  for (const std::string_view field : kMeasurementFields) {
    if (ascii_iequals(field, name)) return std::string(field);
  }
  return options_.leaves_out_others ? std::string() : std::string(name);
}

Result<void> ShopRows::Converter::check_export(const Record& record) {
  if (!basis_) return {};
  has_drawn_limits_ = record.cells[*basis_] == "explicit";
  if (record.cells[*source_] == "gauge") return {};
  return at_table_line(ErrorCode::CsvMalformed, record.line, kOfSimulation);
}

std::string ShopRows::Converter::header_of(const Record& record) {
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
    header_.push_back(is_export ? std::string(field_of_export(column, true)) : field_of(column));
  }
  has_clock_ = std::find(header_.begin(), header_.end(), kDate) != header_.end();
  std::string header;
  auto append = [&header, is_first = true](std::string_view name) mutable {
    if (!std::exchange(is_first, false)) header += ';';
    append_csv_cell(header, name, CsvSeparator::Semicolon);
  };
  for (const std::string& name : header_) {
    if (name.empty() || name == kDate || name == kTime) continue;
    append(name);
  }
  if (has_clock_) append(kMeasuredAt);
  for (const auto& [field, value] : options_.constants) {
    if (std::find(header_.begin(), header_.end(), field) == header_.end()) append(field);
  }
  header.append(std::max<std::size_t>(record.lines, 1), '\n');
  return header;
}

const std::string* ShopRows::Converter::cell(const Record& record, std::string_view field) const {
  const auto found = std::find(header_.begin(), header_.end(), field);
  return found == header_.end() ? nullptr
                                : &record.cells[static_cast<std::size_t>(found - header_.begin())];
}

Result<std::string> ShopRows::Converter::measured_at(const Record& record,
                                                     std::string_view text) const {
  auto instant = instant_text(bare(text), options_.zone);  // the reader of fields checks others
  if (!instant)
    return at_table_line(ErrorCode::TimeMalformed, record.line, instant.error().message);
  return instant;
}

Result<void> ShopRows::Converter::convert_row(const Record& record, std::string& rows) {
  if (record.is_empty()) {
    rows.append(record.lines, '\n');
    return {};
  }
  if (record.cells.size() != header_.size()) {
    return at_table_line(
        ErrorCode::CsvMalformed, record.line,
        fmt::format("has {} cells, and the header has {}", record.cells.size(), header_.size()));
  }
  TRY(check_export(record));
  bool is_first = true;
  std::size_t inside = 0;  // line ends in cells that are kept
  const auto append = [&](std::string_view value) {
    if (!std::exchange(is_first, false)) rows += ';';
    inside += static_cast<std::size_t>(std::count(value.begin(), value.end(), '\n'));
    append_csv_cell(rows, value, CsvSeparator::Semicolon);
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
    const auto at = TRY(measured_at(record, value));
    append(at);
  }
  if (has_clock_) {
    const std::string* const time = cell(record, kTime);
    const auto at = TRY(measured_at(
        record, fmt::format("{} {}", bare(*cell(record, kDate)), time ? bare(*time) : "00:00")));
    append(at);
  }
  for (const auto& [field, value] : options_.constants) {
    if (std::find(header_.begin(), header_.end(), field) == header_.end()) append(value);
  }
  rows.append(record.lines - std::min(record.lines, inside), '\n');
  return {};
}

Result<std::string> ShopRows::Converter::read_header() {
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
  if (records_.is_at_end()) {
    return at_table_line(ErrorCode::CsvMalformed, records_.line(), "must have the column names");
  }
  records_.set_separator(separator.value_or(separator_of(first)));
  TRY(records_.next(record_));
  // After the header, so that the next lines keep their numbers.
  return header_of(record_) + std::string(before, '\n');
}

Result<bool> ShopRows::Converter::append(std::string& rows) {
  const auto more = records_.next(record_);
  if (!more || !*more) return more;
  TRY(convert_row(record_, rows));
  return true;
}

ShopRows::ShopRows(std::unique_ptr<Converter> converter, std::string header)
    : converter_(std::move(converter)), header_(std::move(header)) {}
ShopRows::ShopRows(ShopRows&&) noexcept = default;
ShopRows& ShopRows::operator=(ShopRows&&) noexcept = default;
ShopRows::~ShopRows() = default;

Result<ShopRows> ShopRows::open(const Read& first, Read again, ShopCsvOptions options) {
  auto input = TRY(Utf8Input::open(first, std::move(again), options.encoding));
  auto converter = std::make_unique<Converter>(std::move(input), std::move(options));
  auto header = TRY(converter->read_header());
  return ShopRows(std::move(converter), std::move(header));
}

Result<bool> ShopRows::append(std::string& rows) { return converter_->append(rows); }

}  // namespace fitgauge::sheet

#include "formats/dfq/measurement_csv.hpp"

#include "base/clock.hpp"
#include "base/csv.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "formats/sheet/record_reader.hpp"

namespace fitgauge::aqdef {
namespace {

// Places between the separators of a value.
constexpr std::size_t kAttributeCell = 1;
constexpr std::size_t kTimeCell = 2;
constexpr std::size_t kBatchCell = 4;
constexpr std::size_t kOperatorCell = 6;
constexpr std::size_t kMachineCell = 7;
constexpr std::size_t kGaugeCell = 9;
/// Cells without a field in a measurement: events, cavity, process parameters.
constexpr std::array<std::size_t, 3> kCarriedCells = {3, 5, 8};

constexpr std::size_t kMostAppended = std::size_t{1} << 16;  ///< bytes, before another value

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

}  // namespace

MeasurementCsv::MeasurementCsv(Read read, MeasurementOptions options)
    : options_(std::move(options)),
      reader_(std::move(read), options_.encoding),
      header_(fmt::format("{}\n", fmt::join(kNames, ";"))) {
  for (const auto& [column, field] : options_.columns) {
    if (!is_field_line(column) || column.size() != 5) continue;  // a column of a table
    const auto number = parse_field_line(column);
    mapped_.emplace_back(number->number, place_of(field));
  }
}

std::optional<std::size_t> MeasurementCsv::mapped_place(int number) const {
  for (const auto& [mapped, place] : mapped_) {
    if (mapped == number) return place;
  }
  return std::nullopt;
}

Result<std::string_view> MeasurementCsv::utf8(std::string_view text) {
  if (is_ascii(text)) return text;
  auto decoded = TRY(reader_.description().decoded(text));
  return std::string_view(texts_.emplace_back(std::move(decoded)));
}

std::string_view MeasurementCsv::entry(int first_field, int second_field,
                                       std::string_view number) const {
  number = trim(number);
  const auto index = read_number<std::uint32_t>(number);
  if (!index) return number;
  if (*index == 0) return {};
  const Description& description = reader_.description();
  const std::string_view first = description.catalogue_text(first_field, *index);
  if (!first.empty()) return first;
  const std::string_view second = description.catalogue_text(second_field, *index);
  return second.empty() ? number : second;
}

Result<std::string_view> MeasurementCsv::time_of(std::string_view text) {
  text = trim(text);
  if (text == last_time_) return std::string_view(last_instant_);
  auto instant = sheet::instant_text(text, options_.zone);
  if (!instant) return Error{kMalformed, instant.error().message};
  if (*instant == text && !parse_rfc3339(text)) {
    return Error{kMalformed,
                 fmt::format("has the time '{}', which must be such as 20.11.2026/08:00:00",
                             first_characters(text, 40))};
  }
  last_instant_ = *std::move(instant);
  last_time_ = text;
  return std::string_view(last_instant_);
}

Result<bool> MeasurementCsv::is_measured(const ValueSet& set, const Value& value) const {
  const std::string_view attribute = trim(set.cell(value, kAttributeCell));
  if (attribute == "255" || attribute == "256") return false;
  if (!attribute.empty() && attribute != "0") {
    if (options_.leaves_out_others) return false;
    return at_line(
        value.line,
        fmt::format(
            "has attribute {}, so its value was not measured: leave_out stores the other values",
            first_characters(attribute, 20)));
  }
  if (!trim(set.cell(value, 0)).empty()) return true;
  for (std::size_t place = 1; place < value.cells; ++place) {
    if (trim(set.cell(value, place)).empty()) continue;
    return at_line(
        value.line,
        fmt::format("has no value of characteristic {}: write it, or the attribute 255 or 256",
                    value.characteristic));
  }
  return false;
}

Result<void> MeasurementCsv::take_value_fields(const ValueSet& set_of, const Value& value) {
  const auto take = [&](std::size_t place, std::string_view text) -> Result<void> {
    if (trim(text).empty()) return {};
    const auto decoded = TRY(utf8(trim(text)));
    set(place, decoded);
    return {};
  };
  if (const auto time = trim(set_of.cell(value, kTimeCell)); !time.empty()) {
    const auto instant = TRY(time_of(time));
    set(kMeasuredAt, instant);
  }
  std::string_view batch = trim(set_of.cell(value, kBatchCell));
  if (batch.starts_with('#')) batch.remove_prefix(1);
  const std::string_view machine =
      entry(k::kMachineNumber, k::kMachineName, set_of.cell(value, kMachineCell));
  const std::string_view gauge =
      entry(k::kGaugeNumber, k::kGaugeName, set_of.cell(value, kGaugeCell));
  const std::string_view worker = set_of.cell(value, kOperatorCell);
  std::string_view name = entry(k::kOperatorName, k::kOperatorFirstName, worker);
  if (const auto first = entry(k::kOperatorFirstName, k::kOperatorName, worker); first != name) {
    name = texts_.emplace_back(fmt::format("{} {}", first, name));
  }
  for (const auto& [place, text] :
       {std::pair(kSubgroup, batch), std::pair(kMachine, machine), std::pair(kGauge, gauge),
        std::pair(kOperator, name), std::pair(kPartId, set_of.field(value, k::kPartIdent)),
        std::pair(kOrder, set_of.field(value, k::kOrder)),
        std::pair(kComment, set_of.field(value, k::kText))}) {
    TRY(take(place, text));
  }
  for (const auto& [number, place] : mapped_) {
    if (level_of(number) != Level::Value || place >= kNames.size()) continue;
    std::string_view text = set_of.field(value, number);
    const auto* const cell = std::find(kCells.begin(), kCells.end(), number);
    if (cell != kCells.end()) {
      text = set_of.cell(value, static_cast<std::size_t>(cell - kCells.begin()));
    }
    TRY(take(place, text));
  }
  return {};
}

void MeasurementCsv::take_comment(const ValueSet& set_of, const Value& value,
                                  const Prepared& prepared) {
  Comment comment{.text = std::string(row_[kComment]), .fields = {}};
  const auto carry = [&](int number, std::string_view text) {
    text = trim(text);
    if (text.empty() || mapped_place(number)) return;
    const auto decoded = utf8(text);
    comment.fields.push_back({.number = number, .text = std::string(decoded ? *decoded : text)});
  };
  for (const std::size_t place : kCarriedCells) {
    const std::string_view text = set_of.cell(value, place);
    if (trim(text) != "0") carry(kCells.at(place), text);
  }
  for (const ValueField& field : set_of.fields) {
    const bool is_its = field.characteristic == value.characteristic || field.characteristic == 0;
    const bool is_taken =
        field.number == k::kPartIdent || field.number == k::kOrder || field.number == k::kText;
    const bool is_there =
        std::any_of(comment.fields.begin(), comment.fields.end(),
                    [&](const CarriedField& other) { return other.number == field.number; });
    if (is_its && !is_taken && !is_there) carry(field.number, set_of.field(value, field.number));
  }
  std::stable_sort(
      comment.fields.begin(), comment.fields.end(),
      [](const CarriedField& a, const CarriedField& b) { return a.number < b.number; });
  comment.fields.insert(comment.fields.end(), prepared.carried.begin(), prepared.carried.end());
  if (comment.fields.empty()) return;
  row_[kComment] = texts_.emplace_back(format_comment(comment));
}

Result<void> MeasurementCsv::append_value(const ValueSet& set_of, const Value& value,
                                          const Prepared& prepared, std::string& rows) {
  texts_.clear();
  row_.assign(prepared.fields.begin(), prepared.fields.end());
  const std::string_view text = trim(set_of.cell(value, 0));
  const auto measured = parse_length(text, prepared.unit);
  if (!measured) {
    return at_line(value.line, fmt::format("has the value '{}', which is not a length",
                                           first_characters(text, 40)));
  }
  row_[kMeasured] = texts_.emplace_back(format_mm(*measured));
  if (const auto taken = take_value_fields(set_of, value); !taken) {
    return at_line(value.line, taken.error().message);
  }
  take_comment(set_of, value, prepared);
  sheet::append_row(rows, row_);
  return {};
}

Result<bool> MeasurementCsv::append(std::string& rows, std::vector<std::uint32_t>& lines) {
  if (next_value_ == set_.values.size()) {
    const auto next = reader_.next(set_);
    if (!next || !*next) return next;
    next_value_ = 0;
  }
  const std::size_t before = rows.size();
  while (next_value_ < set_.values.size() && rows.size() - before < kMostAppended) {
    const Value& value = set_.values[next_value_++];
    const auto made = TRY(prepared(value.characteristic));
    if (made->is_left_out) {
      has_left_out_ = true;
      continue;
    }
    const auto measured = TRY(is_measured(set_, value));
    if (!measured) continue;
    TRY(append_value(set_, value, *made, rows));
    lines.push_back(value.line);
    has_values_ = true;
  }
  return true;
}

Result<void> MeasurementCsv::check() const {
  TRY(reader_.check());
  if (!has_values_ && has_left_out_) {
    return Error{
        kMalformed,
        "all values were left out: no characteristic of the file is a length with a nominal "
        "size and limits"};
  }
  if (!has_values_) {
    return Error{kMalformed,
                 "the file has no measured value; a DFD is read together with its DFX, of the same "
                 "name"};
  }
  return {};
}

}  // namespace fitgauge::aqdef

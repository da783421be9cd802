#include "formats/dfq/measurement_csv.hpp"

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
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Fields of the measurements in the user field of a characteristic.
constexpr std::array<std::string_view, 11> kUserFields = {
    "feature",      "quantity",           "rule",          "uncertainty_um", "coverage_factor",
    "probability",  "degrees_of_freedom", "size_operator", "envelope",       "go_gauge",
    "inside_corner"};

constexpr std::size_t kMostBytes = std::size_t{8} << 20;  ///< all prepared texts

/// A characteristic without any of them has no limits.
constexpr std::array<int, 5> kTolerances = {k::kToleranceClass, k::kLowerLimit, k::kUpperLimit,
                                            k::kLowerAllowance, k::kUpperAllowance};

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

        "has attribute {}, so its value was not measured: leave_out stores the other values",
        first_characters(attribute, 20));
  }
  if (!trim(set.cell(value, 0)).empty()) return true;
  for (std::size_t place = 1; place < value.cells; ++place) {
    if (trim(set.cell(value, place)).empty()) continue;
    return at_line(value.line,
                   "has no value of characteristic {}: write it, or the attribute 255 or 256",
                   value.characteristic);
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
  if (const auto first = entry(k::kOperatorFirstName, k::kOperatorName, worker); first != name)
    name = texts_.emplace_back(fmt::format("{} {}", first, name));
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
    const auto* const cell = std::ranges::find(kCells, number);
    if (cell != kCells.end())
      text = set_of.cell(value, static_cast<std::size_t>(cell - kCells.begin()));
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
    const bool is_there = std::ranges::any_of(
        comment.fields, [&](const CarriedField& other) { return other.number == field.number; });
    if (is_its && !is_taken && !is_there) carry(field.number, set_of.field(value, field.number));
  }
  std::ranges::stable_sort(comment.fields, [](const CarriedField& a, const CarriedField& b) {
    return a.number < b.number;
  });
  comment.fields.insert(comment.fields.end(), prepared.carried.begin(), prepared.carried.end());
  if (comment.fields.empty()) return;
  row_[kComment] = texts_.emplace_back(format_comment(comment));
}

Result<void> MeasurementCsv::append_value(const ValueSet& set_of, const Value& value,
                                          const Prepared& prepared, std::string& rows) {
  texts_.clear();
  row_.assign(prepared.fields.begin(), prepared.fields.end());
  const std::string_view text = trim(set_of.cell(value, 0));
  const auto measured = sheet::parse_length(text, prepared.unit);
  if (!measured) {
    return at_line(value.line, "has the value '{}', which is not a length",
                   first_characters(text, 40));
  }
  row_[kMeasured] = texts_.emplace_back(format_mm(*measured));
  if (const auto taken = take_value_fields(set_of, value); !taken)
    return at_line(value.line, taken.error().message);
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
    return Error{kMalformed,
                 "all values were left out: no characteristic of the file is a length with a "
                 "nominal size and limits"};
  }
  if (!has_values_) {
    return Error{
        kMalformed,
        "the file has no measured value; a DFD is read together with its DFX, of the same name"};
  }
  return {};
}

std::string MeasurementCsv::described_name(const Characteristic& characteristic) const {
  const Description& description = reader_.description();
  const std::string_view number = description.text(characteristic, k::kNumber);
  const std::string_view name = description.text(characteristic, k::kDescription);
  if (name.empty()) return std::string(number);
  for (std::uint32_t index = 1; index <= description.count(); ++index) {
    const Characteristic* const other = description.characteristic(index);
    if (other == nullptr || other == &characteristic || other->part != characteristic.part ||
        description.text(*other, k::kDescription) != name) {
      continue;
    }
    if (description.text(*other, k::kNumber) != number) return fmt::format("{} {}", number, name);
  }
  return std::string(name);
}

std::string MeasurementCsv::reason_against(const Characteristic& characteristic) const {
  const Description& description = reader_.description();
  const std::string_view type = description.text(characteristic, k::kType);
  if (!type.empty() && type != "0")
    return fmt::format("it is of type {} (K2004), not measured", type);
  const std::string_view unit = description.text(characteristic, k::kUnit);
  if (!unit.empty() && !sheet::length_unit(unit))
    return fmt::format("its unit {} is not a length", first_characters(unit, 40));
  const std::string_view nominal = description.text(characteristic, k::kNominal);
  if (nominal.empty()) return "it has no nominal value (K2101)";
  const auto size = sheet::parse_length(nominal, sheet::LengthUnit::Millimetre);
  const auto quantity =
      gauging::quantity_from_word(user_text(description, characteristic, "quantity"));
  if (size && *size <= Length() && !(quantity && gauging::is_signed(*quantity)))
    return "its nominal value (K2101) is not above 0";
  const bool is_toleranced = std::ranges::any_of(
      kTolerances, [&](int number) { return description.find(characteristic, number) != nullptr; });
  return is_toleranced ? "" : "it has no limits (K2110, K2111)";
}

Result<void> MeasurementCsv::prepare_size(const Characteristic& characteristic,
                                          Prepared& made) const {
  const Description& description = reader_.description();
  const auto read =
      TRY(read_tolerance(description, characteristic, options_.length_unit, options_.limits_of));
  made.unit = read.unit;
  made.fields[kNominal] = format_mm(read.nominal);
  for (const std::string_view name : kUserFields) {
    const std::string_view said = user_text(description, characteristic, name);
    if (!said.empty()) made.fields[place_of(name)] = said;
  }
  if (!read.class_name.empty()) made.fields[kClass] = read.class_name;
  if (!made.fields[kClass].empty()) {
    made.fields[kFeature].clear();
    return {};
  }
  if (read.limits.upper) made.fields[kUpper] = format_um(*read.limits.upper - read.nominal);
  if (read.limits.lower) made.fields[kLower] = format_um(*read.limits.lower - read.nominal);
  const auto quantity = gauging::quantity_from_word(made.fields[kQuantity]);
  if (made.fields[kFeature].empty() && (!quantity || gauging::has_feature(*quantity))) {
    return at_line(characteristic.line,
                   "has limits of characteristic {} without hole or shaft: set feature, or write "
                   "its class into K2103 and K2104",
                   characteristic.index);
  }
  return {};
}

Result<MeasurementCsv::Prepared> MeasurementCsv::prepare(
    const Characteristic& characteristic) const {
  const Description& description = reader_.description();
  Prepared made{.fields = std::vector<std::string>(kNames.size())};
  if (const std::string reason = reason_against(characteristic); !reason.empty()) {
    if (!options_.leaves_out_others) {
      return at_line(characteristic.line,
                     "describes characteristic {}, which is not a measurement: {}; leave_out "
                     "stores the other characteristics",
                     characteristic.index, reason);
    }
    made.is_left_out = true;
    return made;
  }
  for (const auto& [field, value] : options_.constants) {
    const std::size_t place = place_of(field);
    if (place < kNames.size()) made.fields[place] = value;
  }
  TRY(prepare_size(characteristic, made));
  const auto take = [&made](std::size_t place, std::string_view text) {
    if (!text.empty()) made.fields[place] = text;
  };
  take(kName, described_name(characteristic));
  take(kOrder, description.part_text(characteristic, k::kContract));
  take(kOperation, description.part_text(characteristic, k::kOperation));
  take(kUnit, description.part_text(characteristic, k::kArea));
  take(kUnit, description.part_text(characteristic, k::kPlant));
  take(kMachine, description.part_text(characteristic, k::kPartMachine));
  take(kMachine, description.part_text(characteristic, k::kPartMachineNumber));
  for (const auto& [number, place] : mapped_) {
    if (place >= kNames.size()) continue;
    take(place, description.part_text(characteristic, number));
    take(place, description.text(characteristic, number));
  }
  for (const int number : {k::kPartNumber, k::kPartDescription}) {
    const std::string_view text = description.part_text(characteristic, number);
    if (text.empty() || mapped_place(number)) continue;
    made.carried.push_back({.number = number, .text = std::string(text)});
  }
  return made;
}

Result<const MeasurementCsv::Prepared*> MeasurementCsv::prepared(std::uint32_t index) {
  if (prepared_.size() <= index) prepared_.resize(index + 1);
  if (!prepared_[index]) {
    auto made = TRY(prepare(*reader_.description().characteristic(index)));
    for (const std::string& text : made.fields) prepared_bytes_ += text.size();
    for (const CarriedField& field : made.carried) prepared_bytes_ += field.text.size();
    if (prepared_bytes_ > kMostBytes) {
      return Error{kMalformed, fmt::format("the texts of the characteristics and parts have more "
                                           "than {} MiB: shorten them, or split the file",
                                           kMostBytes >> 20)};
    }
    prepared_[index] = std::move(made);
  }
  return &*prepared_[index];
}

}  // namespace fitgauge::aqdef

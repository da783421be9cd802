// Fields that all values of a characteristic share: its name, size, limits and user field, and its
// missing fields.

#include "base/text.hpp"
#include "formats/dfq/measurement_csv.hpp"
#include "formats/sheet/record_reader.hpp"
#include "metrology/gauging/gauge.hpp"

namespace fitgauge::aqdef {
namespace {

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
  if (!unit.empty() && !length_unit(unit)) {
    return fmt::format("its unit {} is not a length", first_characters(unit, 40));
  }
  const std::string_view nominal = description.text(characteristic, k::kNominal);
  if (nominal.empty()) return "it has no nominal value (K2101)";
  const auto size = parse_length(nominal, LengthUnit::Millimetre);
  const auto quantity =
      gauging::quantity_from_word(user_text(description, characteristic, "quantity"));
  if (size && *size <= Length() && !(quantity && gauging::is_signed(*quantity)))
    return "its nominal value (K2101) is not above 0";
  const bool is_toleranced = std::any_of(kTolerances.begin(), kTolerances.end(), [&](int number) {
    return description.find(characteristic, number) != nullptr;
  });
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
                   fmt::format("has limits of characteristic {} without hole or shaft: set "
                               "feature, or write its class into K2103 and K2104",
                               characteristic.index));
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
                     fmt::format("describes characteristic {}, which is not a measurement: {}; "
                                 "leave_out stores the other characteristics",
                                 characteristic.index, reason));
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
      return Error{kMalformed,
                   fmt::format("the texts of the characteristics and parts have more than {} MiB: "
                               "shorten them, or split the file",
                               kMostBytes >> 20)};
    }
    prepared_[index] = std::move(made);
  }
  return &*prepared_[index];
}

}  // namespace fitgauge::aqdef

#include "formats/dfq/description.hpp"

#include "base/length.hpp"
#include "base/text.hpp"

namespace fitgauge::aqdef {
namespace {

constexpr std::array<std::pair<std::string_view, LengthUnit>, 20> kUnits = {{
    {"mm", LengthUnit::Millimetre},
    {"millimeter", LengthUnit::Millimetre},
    {"millimetre", LengthUnit::Millimetre},
    {"\xC2\xB5m", LengthUnit::Micrometre},
    {"\xCE\xBCm", LengthUnit::Micrometre},
    {"\xC2\xB5", LengthUnit::Micrometre},
    {"um", LengthUnit::Micrometre},
    {"my", LengthUnit::Micrometre},
    {"micrometer", LengthUnit::Micrometre},
    {"micrometre", LengthUnit::Micrometre},
    {"cm", LengthUnit::Centimetre},
    {"m", LengthUnit::Metre},
    {"meter", LengthUnit::Metre},
    {"metre", LengthUnit::Metre},
    {"in", LengthUnit::Inch},
    {"in.", LengthUnit::Inch},
    {"inch", LengthUnit::Inch},
    {"inches", LengthUnit::Inch},
    {"zoll", LengthUnit::Inch},
    {"\"", LengthUnit::Inch},
}};

/// Digits after the point of a value of one nanometre.
constexpr int decimals_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Micrometre: return 3;
    case LengthUnit::Centimetre: return 7;
    case LengthUnit::Metre:
    case LengthUnit::Inch: return 9;
    default: return 6;
  }
}

std::string_view tolerance_name(int number) { return field_info(number)->name; }

/// Reads the lengths of one characteristic.
class ToleranceReader {
 public:
  ToleranceReader(const Description& description, const Characteristic& characteristic)
      : description_(description), characteristic_(characteristic) {}

  Result<Toleranced> read(std::optional<LengthUnit> fallback, const LimitsOfClass& limits_of);

 private:
  Error wrong(const Described* field, std::string_view what) const {
    return at_line(field == nullptr ? characteristic_.line : field->line, what);
  }
  const Described* find(int number) const { return description_.find(characteristic_, number); }
  Result<std::optional<Length>> length(int number) const;
  /// Returns the upper or lower deviation, from its limit or its allowance.
  Result<std::optional<Length>> limit(int limit_number, int allowance_number,
                                      int type_number) const;
  Result<void> check_class(const LimitsOfClass& limits_of) const;

  const Description& description_;
  const Characteristic& characteristic_;
  Toleranced read_{};
};

Result<std::optional<Length>> ToleranceReader::length(int number) const {
  const Described* const field = find(number);
  if (field == nullptr) return std::optional<Length>();
  const auto value = parse_length(field->text, read_.unit);
  if (!value) {
    return wrong(field,
                 fmt::format("has '{}' in K{:04}, the {}, which must be a number",
                             first_characters(field->text, 40), number, tolerance_name(number)));
  }
  return std::optional(*value);
}

Result<std::optional<Length>> ToleranceReader::limit(int limit_number, int allowance_number,
                                                     int type_number) const {
  const Described* const type = find(type_number);
  if (type != nullptr && type->text != "0" && type->text != "1" && type->text != "2") {
    return wrong(
        type, fmt::format(
                  "has '{}' in K{:04}, which must be 0 (no limit), 1 (limit) or 2 (natural limit)",
                  first_characters(type->text, 40), type_number));
  }
  auto limit = length(limit_number);
  if (!limit) return limit;
  const auto allowance = TRY(length(allowance_number));
  if (type != nullptr && type->text != "1") return std::optional<Length>();
  if (!allowance) return limit;
  const Length by_allowance = read_.nominal + *allowance;
  if (*limit && **limit != by_allowance) {
    return wrong(
        find(limit_number),
        fmt::format("has {} mm in K{:04}, but K{:04} gives {} mm: correct one of them",
                    format_mm(**limit), limit_number, allowance_number, format_mm(by_allowance)));
  }
  return std::optional(by_allowance);
}

Result<void> ToleranceReader::check_class(const LimitsOfClass& limits_of) const {
  if (!limits_of) return {};
  const auto limits = limits_of(read_.nominal, read_.class_name);
  if (!limits) {
    return wrong(find(k::kToleranceClass), fmt::format("has {} in K2103 and K2104: {}",
                                                       read_.class_name, limits.error().message));
  }
  const auto agree = [&](const std::optional<Length>& said, const std::optional<Length>& by_class,
                         int number) -> Result<void> {
    if (!said || said == by_class) return {};
    const Described* const field = find(number);
    return wrong(field != nullptr ? field : find(k::kToleranceClass),
                 fmt::format("has {} mm in K{:04}, but {} of {} mm gives {} mm: correct one of "
                             "them, or remove K2103 and K2104",
                             format_mm(*said), number, read_.class_name, format_mm(read_.nominal),
                             by_class ? format_mm(*by_class) : "none"));
  };
  TRY(agree(read_.limits.lower, limits->lower, k::kLowerLimit));
  return agree(read_.limits.upper, limits->upper, k::kUpperLimit);
}

Result<Toleranced> ToleranceReader::read(std::optional<LengthUnit> fallback,
                                         const LimitsOfClass& limits_of) {
  const Described* const unit = find(k::kUnit);
  const auto known = unit == nullptr ? fallback : length_unit(unit->text);
  if (!known) {
    return unit == nullptr
               ? wrong(nullptr, fmt::format("describes characteristic {}, which has no unit: write "
                                            "K2142, or set length_unit",
                                            characteristic_.index))
               : wrong(unit,
                       fmt::format(
                           "has the unit '{}', which must be one of: mm, \xC2\xB5m, cm, m, inch",
                           first_characters(unit->text, 40)));
  }
  read_.unit = *known;
  const auto nominal = TRY(length(k::kNominal));
  if (!nominal) {
    return wrong(nullptr, fmt::format("describes characteristic {}, which has no nominal value: "
                                      "write K2101",
                                      characteristic_.index));
  }
  read_.nominal = *nominal;
  const auto lower = TRY(limit(k::kLowerLimit, k::kLowerAllowance, k::kLowerLimitType));
  const auto upper = TRY(limit(k::kUpperLimit, k::kUpperAllowance, k::kUpperLimitType));
  read_.limits = {.upper = upper, .lower = lower};
  if (lower && upper && *upper < *lower)
    return wrong(find(k::kUpperLimit), "has an upper limit that is below the lower one");
  const Described* const letter = find(k::kToleranceClass);
  const Described* const grade = find(k::kToleranceGrade);
  if ((letter == nullptr) != (grade == nullptr)) {
    return wrong(letter == nullptr ? grade : letter,
                 "has only one of K2103 and K2104: write both, such as H and 7");
  }
  read_.class_name = letter == nullptr
                         ? std::string(user_text(description_, characteristic_, "class"))
                         : letter->text + grade->text;
  if (read_.class_name.empty()) return read_;
  TRY(check_class(limits_of));
  return read_;
}

}  // namespace

std::optional<LengthUnit> length_unit(std::string_view name) {
  for (const auto& [known, unit] : kUnits) {
    if (ascii_iequals(known, name)) return unit;
  }
  return std::nullopt;
}

std::string_view user_text(const Description& description, const Characteristic& characteristic,
                           std::string_view name) {
  if (description.text(characteristic, k::kUserName) != "fitgauge") return {};
  std::string_view rest = description.text(characteristic, k::kUserText);
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=') {
      return one.substr(name.size() + 1);
    }
  }
  return {};
}

Result<Toleranced> read_tolerance(const Description& description,
                                  const Characteristic& characteristic,
                                  std::optional<LengthUnit> fallback,
                                  const LimitsOfClass& limits_of) {
  return ToleranceReader(description, characteristic).read(fallback, limits_of);
}

Result<Length> parse_length(std::string_view text, LengthUnit unit) {
  const auto value = parse_decimal(text, {.scale = decimals_of(unit),
                                          .decimal_comma = true,
                                          .exponent = true,
                                          .round_to_nearest = true});
  if (!value) {
    return Error{value.error().code == ErrorCode::NumberOutOfRange ? ErrorCode::LengthOutOfRange
                                                                   : ErrorCode::LengthMalformed,
                 value.error().message};
  }
  std::int64_t nanometres = *value;
  if (unit == LengthUnit::Inch) {
    // 25.4 mm are 254 tenths: of 1e-9 inch, divided by 10,000.
    constexpr std::int64_t kMost = 36'000'000'000'000'000;
    if (nanometres > kMost || nanometres < -kMost) {
      return Error{ErrorCode::LengthOutOfRange, "is too long"};
    }
    const std::int64_t half = nanometres < 0 ? -5'000 : 5'000;
    nanometres = (nanometres * 254 + half) / 10'000;
  }
  const Length length = Length::nanometres(nanometres);
  if (length > kLongest || length < -kLongest) {
    return Error{ErrorCode::LengthOutOfRange, "is too long"};
  }
  return length;
}

}  // namespace fitgauge::aqdef

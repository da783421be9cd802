#include "formats/sheet/lengths.hpp"

namespace fitgauge::sheet {
namespace {

/// The names of each unit, in the order of LengthUnit.
constexpr std::array<std::string_view, 9> kUnits[] = {
    {"mm", "millimeter", "millimetre"},
    {"\xC2\xB5m", "\xCE\xBCm", "\xC2\xB5", "um", "my", "micrometer", "micrometre"},
    {"cm"},
    {"m", "meter", "metre"},
    {"in", "in.", "inch", "inches", "zoll", "\""}};

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

}  // namespace

std::optional<LengthUnit> length_unit(std::string_view name) {
  const auto* const found = std::ranges::find_if(kUnits, [name](const auto& names) {
    return !name.empty() && std::ranges::any_of(names, [name](std::string_view known) {
      return ascii_iequals(known, name);
    });
  });
  if (found == std::end(kUnits)) return std::nullopt;
  return static_cast<LengthUnit>(found - kUnits);
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
    if (nanometres > kMost || nanometres < -kMost)
      return Error{ErrorCode::LengthOutOfRange, "is too long"};
    const std::int64_t half = nanometres < 0 ? -5'000 : 5'000;
    nanometres = (nanometres * 254 + half) / 10'000;
  }
  const Length length = Length::nanometres(nanometres);
  if (length > kLongest || length < -kLongest)
    return Error{ErrorCode::LengthOutOfRange, "is too long"};
  return length;
}

std::optional<std::string> difference(std::string_view field, std::optional<Length> in_file,
                                      std::optional<Length> of_class, Length nominal,
                                      std::string_view class_name) {
  if (!in_file || in_file == of_class) return std::nullopt;
  return fmt::format("has {} mm in {}, but {} of {} mm gives {}", format_mm(*in_file), field,
                     class_name, format_mm(nominal),
                     of_class ? format_mm(*of_class) + " mm" : "none");
}

}  // namespace fitgauge::sheet

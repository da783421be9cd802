#pragma once

#include "base/length.hpp"

namespace fitgauge::sheet {

/// A unit of length, as files name it.
enum class LengthUnit : std::uint8_t { Millimetre, Micrometre, Centimetre, Metre, Inch };

/// `mm`, `µm`, `cm`, `m`, `inch` and other usual names, in either case.
std::optional<LengthUnit> length_unit(std::string_view name);

/// To the nearest nanometre, as measured values are read. A decimal comma and an exponent are.
/// @errors LengthMalformed, LengthOutOfRange
Result<Length> parse_length(std::string_view text, LengthUnit unit);

struct SizeLimits {
  std::optional<Length> upper{};
  std::optional<Length> lower{};

  friend bool operator==(const SizeLimits&, const SizeLimits&) = default;
};

/// Limits of a class for a nominal size, from the tables.
using LimitsOfClass = std::function<Result<SizeLimits>(Length nominal, const std::string& name)>;

/// Compares a limit of a file with the limit that its class gives.
/// @param field of the file. @returns the difference, without a remedy; nothing if they agree, or
/// the file has no such limit.
std::optional<std::string> difference(std::string_view field, std::optional<Length> in_file,
                                      std::optional<Length> of_class, Length nominal,
                                      std::string_view class_name);

}  // namespace fitgauge::sheet

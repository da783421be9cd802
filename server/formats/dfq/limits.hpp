#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/length.hpp"
#include "base/result.hpp"
#include "formats/dfq/description.hpp"

namespace fitgauge::aqdef {

/// A unit of length, as K2142 names it.
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

/// The limits of a class for a nominal size, as the tables say.
using LimitsOfClass = std::function<Result<SizeLimits>(Length nominal, const std::string& name)>;

/// What a characteristic says of its size.
struct Toleranced {
  LengthUnit unit = LengthUnit::Millimetre;
  Length nominal{};
  std::string class_name{};  ///< `H7`; empty: the limits are those of the drawing
  SizeLimits limits{};       ///< of a class too, as far as they are said
};

/// What the user field of fitgauge says of a characteristic (K2800 to K2802): `name=…`, or nothing.
std::string_view user_text(const Description& description, const Characteristic& characteristic,
                           std::string_view name);

/// Reads K2101 to K2142 of a characteristic. A natural limit is none.
/// @param fallback the unit where K2142 says none. @param limits_of may be null: then the limits of
///   a class are not compared with those of the tables.
/// @errors kMalformed with the line: it is no length, or its fields contradict each other.
Result<Toleranced> read_tolerance(const Description& description,
                                  const Characteristic& characteristic,
                                  std::optional<LengthUnit> fallback,
                                  const LimitsOfClass& limits_of);

}  // namespace fitgauge::aqdef

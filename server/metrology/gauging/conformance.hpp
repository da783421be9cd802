#pragma once

#include "base/length.hpp"

namespace fitgauge::gauging {

/// The nearest whole number that a double keeps in its decimal digits: a record spells it as
/// RFC 8785 does. @pre |value| < 9e18
inline std::int64_t to_15_digits(double value) {
  constexpr std::int64_t kLimit = 1'000'000'000'000'000;
  const std::int64_t whole = std::llround(value);
  std::int64_t step = 1;
  while (whole / step >= kLimit) step *= 10;
  return (whole + step / 2) / step * step;
}

/// The limits of size a true value conforms to.
struct ConformanceLimits {
  Length upper;
  Length lower;
};

/// The degrees of freedom of an uncertainty that is known exactly.
inline constexpr double kExactly = std::numeric_limits<double>::infinity();

/// A standard uncertainty above 0 with its degrees of freedom.
struct KnownUncertainty {
  Length u;
  double degrees_of_freedom = kExactly;

  // NOLINTNEXTLINE(google-explicit-constructor): a length is one that is known exactly
  KnownUncertainty(Length u_, double degrees_of_freedom_ = kExactly)
      : u(u_), degrees_of_freedom(degrees_of_freedom_) {}
};

/// The factor k whose interval covers 95.45 %: the quantile t(0.9545, ν), in millionths (JCGM
/// 100:2008, G.6.4); at most a million. @pre degrees_of_freedom > 0, finite
std::int64_t coverage_millionths(double degrees_of_freedom);

/// Returns the probability that the true value is within the limits, without prior knowledge:
/// normal around the measured value (JCGM 106:2012, clause 7), Student's t with degrees of freedom.
double conformance_probability(const ConformanceLimits& limits, Length measured,
                               const KnownUncertainty& uncertainty);
/// Returns the probability that it is outside: 1 - conformance_probability, with all its digits.
double nonconformance_probability(const ConformanceLimits& limits, Length measured,
                                  const KnownUncertainty& uncertainty);

/// Returns the distance inside both limits, in standard uncertainties, at which a value conforms
/// with exactly this probability: the coverage factor of an equivalent guard band. None if not even
/// the middle of the limits conforms. @pre 0.5 <= probability < 1
std::optional<double> guard_band_factor(Length tolerance, const KnownUncertainty& uncertainty,
                                        double probability);

/// Facts of a value other than its verdict.
struct ConformanceFigures {
  std::int64_t probability = 0;  ///< of conformance, in 1e-9
  std::int64_t guard_band = 0;   ///< in fm, of which 15 digits count

  friend bool operator==(const ConformanceFigures&, const ConformanceFigures&) = default;
};

/// Returns the figures; none if not even the middle of the limits conforms with this probability.
/// @pre as conformance_probability
std::optional<ConformanceFigures> conformance_figures(const ConformanceLimits& limits,
                                                      Length measured,
                                                      const KnownUncertainty& uncertainty,
                                                      double probability);

// Sizes refer to 20 °C (ISO 1:2022); a part and its scale mostly have another temperature.

/// Temperature of a body in millionths of a degree Celsius, and its coefficient of linear expansion
/// in millionths of µm/(m·K).
struct ThermalBody {
  std::int64_t temperature = 20'000'000;
  std::int64_t expansion = 0;
  // Standard uncertainties of temperature and expansion, in their units:
  std::int64_t temperature_uncertainty = 0;
  std::int64_t expansion_uncertainty = 0;

  friend bool operator==(const ThermalBody&, const ThermalBody&) = default;
};

inline constexpr std::int64_t kLargestExpansion = 1'000'000'000;    ///< 1000 µm/(m·K)
inline constexpr std::int64_t kLargestUncertainty = 1'000'000'000;  ///< 1000 K, 1000 µm/(m·K)
inline constexpr std::int64_t kColdest = -273'150'000;
inline constexpr std::int64_t kHottest = 10'000'000'000;

/// The size at 20 °C of a part that was read on a scale: reading (1 + αs(ts - 20)) / (1 + αp(tp -
/// 20)), exactly, then rounded to the nearest nanometre.
/// @pre 0 <= expansion <= kLargestExpansion and kColdest <= temperature <= kHottest, of both
Length size_at_20_degrees(Length reading, const ThermalBody& part, const ThermalBody& scale);

/// Returns the standard uncertainty in pm that temperatures and expansions add to a size at 20 °C:
/// of first order, for independent quantities (JCGM 100:2008, 5.1.2). The sensitivity to a
/// temperature is L α / (1 + α(t - 20)), to an expansion L (t - 20) / (1 + α(t - 20)).
/// @param corrected as of size_at_20_degrees
std::int64_t added_uncertainty(Length corrected, const ThermalBody& part, const ThermalBody& scale);

/// √(u² + added²), rounded up to the nanometre. @param added_pm in pm
Length combined_uncertainty(Length u, std::int64_t added_pm);

/// Standard uncertainty in µm as in measurements, rounded up to the nanometre. None if it is not a
/// length.
std::optional<Length> rounded_up(double micrometres);

/// A material by name, with its mean coefficient near 20 °C and the source.
struct Material {
  std::string_view name;
  std::int64_t expansion;  ///< as ThermalBody has it
  std::string_view source;
  std::int64_t uncertainty = 0;  ///< standard uncertainty of the coefficient; 0: unknown
};
std::span<const Material> materials();
/// Null for a name there is no material of.
const Material* find_material(std::string_view name);

}  // namespace fitgauge::gauging

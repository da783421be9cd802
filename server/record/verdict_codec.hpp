#pragma once

#include "base/json/json_writer.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// The data for the correction of a reading to 20 °C.
struct ThermalCorrection {
  gauging::ThermalBody part;
  gauging::ThermalBody scale;
  bool has_uncertainties = false;  ///< some were given

  Length operator()(Length reading) const {
    return gauging::size_at_20_degrees(reading, part, scale);
  }
  /// Returns the uncertainty of a corrected size in pm; none if no uncertainty was given.
  std::optional<std::int64_t> added_uncertainty(Length corrected) const {
    if (!has_uncertainties) return std::nullopt;
    return gauging::added_uncertainty(corrected, part, scale);
  }
};

/// Returns the correction; none without an expansion: a temperature alone corrects nothing.
/// @errors with the field in `where`: FieldConflict: material and expansion; FieldInvalid: unknown
///   material; FieldMissing: the part's expansion without temperature_c, or an uncertainty of a
///   body without its expansion.
Result<std::optional<ThermalCorrection>> make_correction(const app::MeasurementFields& fields);

/// The largest measured value: 100 km.
inline constexpr Length kLargestMeasured = Length::millimetres(100'000'000);

/// A warning of a response; a stored leaf never has it.
struct Warning {
  std::string_view code;
  std::string detail;
};
/// Writes `"warnings":[{code, detail}]`; nothing without any.
void write_warnings(JsonWriter& json, std::span<const Warning> warnings);

/// Adds `rule.no_acceptance` if the guard bands leave no good value.
void warn_of_no_acceptance(const gauging::DecisionRule& rule, Length tolerance,
                           std::vector<Warning>& warnings);

/// @errors LengthOutOfRange unless 0 < measured <= kLargestMeasured; a position, distance or
///   deviation must be at least -kLargestMeasured.
Result<void> check_measured(Length measured,
                            gauging::Quantity quantity = gauging::Quantity::Diameter);
/// @errors LengthOutOfRange if it is negative.
Result<void> check_uncertainty(Length uncertainty);

/// A decision rule as written in a query or a body.
struct RuleWords {
  gauging::DecisionRule::Kind kind = gauging::DecisionRule::Kind::Simple;
  std::optional<Length> standard_uncertainty{};  ///< as given
  std::optional<std::int64_t> coverage_millionths{};
  std::optional<std::int64_t> probability_millionths{};
  std::optional<std::int64_t> degrees_of_freedom{};  ///< in millionths
  std::optional<std::int64_t> added_uncertainty{};   ///< by the correction to 20 °C, in pm
};
/// √(u² + added²) with its effective degrees of freedom, ν (u_c / u)⁴: what decides.
gauging::KnownUncertainty known_uncertainty(const RuleWords& words);
/// Of a record; u is 0 without an uncertainty.
gauging::KnownUncertainty known_uncertainty(const app::Measurement& measurement);

/// The factor of a guard band that no factor was given for: t(0.9545, ν), or 2 without degrees of
/// freedom.
gauging::CoverageFactor default_coverage(const gauging::KnownUncertainty& known);

/// Makes the rule. Its uncertainty includes the correction to 20 °C, with the effective degrees of
/// freedom (JCGM 100:2008, G.4.1); the added part has infinitely many.
/// @errors RuleInvalid when a guard band or conformance has no uncertainty, or a number is none of
///   the rule's.
Result<gauging::DecisionRule> make_rule(const RuleWords& words);

/// @errors RuleNoAcceptance if conformance leaves no good value.
Result<void> check_acceptance(const gauging::DecisionRule& rule, const gauging::Limits& limits);

/// A measured value: the reading, and its size at 20 °C if the verdict uses it.
struct MeasuredSize {
  Length reading;
  std::optional<Length> corrected{};
  std::optional<std::int64_t> added_uncertainty{};  ///< by the correction, in pm

  Length decisive() const { return corrected.value_or(reading); }
};

/// Writes measured_mm, corrected_mm, added_uncertainty_um, deviation_um, verdict and excess_um.
void write_verdict_members(JsonWriter& json, Length nominal_size, const MeasuredSize& measured,
                           const gauging::GaugingResult& result);

/// Writes the rule with its numbers: uncertainty_um, degrees_of_freedom, coverage_factor of a guard
/// band, probability, conformance_probability and guard_band_um of conformance; nothing for the
/// simple rule.
/// @param words as given; the rule has the uncertainty with what a correction adds
void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule, const RuleWords& words,
                        const gauging::Limits& limits, Length measured);

}  // namespace fitgauge::api

#include "record/verdict_codec.hpp"

#include "base/json/field_reader.hpp"

namespace fitgauge::api {
namespace {

/// Facts of a body in addition to its temperature.
struct BodyWords {
  std::string_view name;  ///< part or scale
  const std::optional<std::int64_t>& expansion;
  const std::optional<std::string_view>& material;
  const std::optional<std::int64_t>& temperature_uncertainty;
  const std::optional<std::int64_t>& expansion_uncertainty;
};

/// The expansion of a body, by its number or its material, with the uncertainties; none without
/// expansion. A material has the uncertainty of its source.
Result<std::optional<gauging::ThermalBody>> read_body(const BodyWords& words) {
  const bool expands = words.expansion || words.material;
  if (!expands && !words.temperature_uncertainty && !words.expansion_uncertainty) {
    return std::optional<gauging::ThermalBody>();
  }
  const std::string field = fmt::format("{}_material", words.name);
  const std::string number = fmt::format("{}_expansion_um_per_m_k", words.name);
  if (words.expansion && words.material) {
    return Error{ErrorCode::FieldConflict, fmt::format("give {} or {}, not both", number, field),
                 field};
  }
  if (!expands) {
    return Error{ErrorCode::FieldMissing,
                 fmt::format("an uncertainty of the {} needs {} or {}", words.name, number, field),
                 number};
  }
  gauging::ThermalBody body;
  if (words.material) {
    const gauging::Material* material = gauging::find_material(*words.material);
    if (material == nullptr) {
      std::string names;
      for (const gauging::Material& known : gauging::materials()) {
        names += names.empty() ? "" : ", ";
        names += known.name;
      }
      return Error{
          ErrorCode::FieldInvalid,
          fmt::format("{} must be one of: {}; for other materials give {}", field, names, number),
          field};
    }
    body.expansion = material->expansion;
    body.expansion_uncertainty = material->uncertainty;
  }
  body.expansion = words.expansion.value_or(body.expansion);
  body.temperature_uncertainty = words.temperature_uncertainty.value_or(0);
  body.expansion_uncertainty = words.expansion_uncertainty.value_or(body.expansion_uncertainty);
  return std::optional(body);
}

/// A record of the simple rule has a coverage factor too, like the uncertainty.
constexpr std::array<Applicable, 2> kRuleMembers = {{
    {"coverage_factor", "simple guard_band"},
    {"probability", "conformance"},
}};

}  // namespace

void write_warnings(JsonWriter& json, std::span<const Warning> warnings) {
  if (warnings.empty()) return;
  json.key("warnings").begin_array();
  for (const Warning& warning : warnings) {
    json.begin_object().member("code", warning.code).member("detail", warning.detail).end_object();
  }
  json.end_array();
}

void warn_of_no_acceptance(const gauging::DecisionRule& rule, Length tolerance,
                           std::vector<Warning>& warnings) {
  if (!gauging::has_no_acceptance(rule, tolerance)) return;
  warnings.push_back(
      {"rule.no_acceptance", fmt::format("no value can be good: two guard bands of {} um times {} "
                                         "are larger than the tolerance of {} um",
                                         format_um(rule.standard_uncertainty()),
                                         format(rule.coverage_factor()), format_um(tolerance))});
}

Result<std::optional<ThermalCorrection>> make_correction(const app::MeasurementFields& fields) {
  auto part = TRY(read_body({.name = "part",
                             .expansion = fields.part_expansion,
                             .material = fields.part_material,
                             .temperature_uncertainty = fields.temperature_uncertainty,
                             .expansion_uncertainty = fields.part_expansion_uncertainty}));
  auto scale = TRY(read_body({.name = "scale",
                              .expansion = fields.scale_expansion,
                              .material = fields.scale_material,
                              .temperature_uncertainty = fields.scale_temperature_uncertainty,
                              .expansion_uncertainty = fields.scale_expansion_uncertainty}));
  if (!part && !scale) return std::optional<ThermalCorrection>();
  if (part && !fields.temperature) {
    return Error{ErrorCode::FieldMissing,
                 "temperature_c of the part is required with its expansion", "temperature_c"};
  }
  ThermalCorrection correction;
  correction.part = part.value_or(gauging::ThermalBody());
  correction.part.temperature = fields.temperature.value_or(correction.part.temperature);
  correction.scale = scale.value_or(gauging::ThermalBody());
  correction.scale.temperature = fields.scale_temperature.value_or(correction.scale.temperature);
  correction.has_uncertainties =
      fields.temperature_uncertainty || fields.part_expansion_uncertainty ||
      fields.scale_temperature_uncertainty || fields.scale_expansion_uncertainty;
  return std::optional(correction);
}

Result<void> check_measured(Length measured, gauging::Quantity quantity) {
  const bool is_signed = gauging::is_signed(quantity);
  const bool is_above = is_signed ? measured >= -kLargestMeasured : measured > Length();
  if (is_above && measured <= kLargestMeasured) return {};
  return Error{ErrorCode::LengthOutOfRange,
               fmt::format("measured {} must be {} and at most {} mm; got {}", word(quantity),
                           is_signed ? "at least -100000000" : "above 0",
                           format_mm(kLargestMeasured), format_mm(measured))};
}

Result<void> check_uncertainty(Length uncertainty) {
  if (uncertainty >= Length()) return {};
  return Error{ErrorCode::LengthOutOfRange, "an uncertainty must not be negative",
               "uncertainty_um"};
}

gauging::KnownUncertainty known_uncertainty(const RuleWords& words) {
  const Length given = words.standard_uncertainty.value_or(Length());
  gauging::KnownUncertainty known(
      gauging::combined_uncertainty(given, words.added_uncertainty.value_or(0)));
  const std::int64_t added = words.added_uncertainty.value_or(0);
  // Of nothing but what the correction to 20 °C adds the degrees of freedom have no end.
  if (!words.degrees_of_freedom || (given == Length() && added != 0)) return known;
  constexpr double kPicometres = 1000;
  const double u = static_cast<double>(given.count()) * kPicometres;
  const double ratio = added == 0 ? 0 : static_cast<double>(added) / u;
  const double widened = 1 + ratio * ratio;
  known.degrees_of_freedom =
      static_cast<double>(*words.degrees_of_freedom) / 1e6 * widened * widened;
  return known;
}

gauging::KnownUncertainty known_uncertainty(const app::Measurement& m) {
  if (!m.standard_uncertainty) return Length();
  return known_uncertainty({.standard_uncertainty = m.standard_uncertainty,
                            .degrees_of_freedom = m.degrees_of_freedom,
                            .added_uncertainty = m.added_uncertainty});
}

gauging::CoverageFactor default_coverage(const gauging::KnownUncertainty& known) {
  if (std::isinf(known.degrees_of_freedom)) return {};
  return gauging::CoverageFactor::from_millionths(
             gauging::coverage_millionths(known.degrees_of_freedom))
      .value();
}

Result<gauging::DecisionRule> make_rule(const RuleWords& words) {
  using Kind = gauging::DecisionRule::Kind;
  if (words.kind == Kind::Simple && !words.probability_millionths) return gauging::DecisionRule();
  const gauging::KnownUncertainty known = known_uncertainty(words);
  gauging::CoverageFactor factor;
  if (words.coverage_millionths) {
    factor = TRY(gauging::CoverageFactor::from_millionths(*words.coverage_millionths));
  } else if (words.kind == Kind::GuardBand) {
    factor = default_coverage(known);
  }
  gauging::ConformanceProbability probability;
  if (words.probability_millionths) {
    probability =
        TRY(gauging::ConformanceProbability::from_millionths(*words.probability_millionths));
  }
  std::optional<Error> unused;
  refuse_not_applicable(
      kRuleMembers, "rule", word(words.kind),
      [&](const Applicable& row) {
        return row.member == "probability" ? words.probability_millionths.has_value()
                                           : words.coverage_millionths.has_value();
      },
      [&](std::string_view member, std::string message) {
        unused = Error{ErrorCode::RuleInvalid, std::move(message), std::string(member)};
      });
  if (unused) return *std::move(unused);
  if (words.kind == Kind::Simple) return gauging::DecisionRule();
  if (!words.standard_uncertainty) {
    return Error{ErrorCode::RuleInvalid, "rule " + std::string(word(words.kind)) +
                                             " needs uncertainty_um, the standard uncertainty"};
  }
  return words.kind == Kind::GuardBand ? gauging::DecisionRule::guard_band(known.u, factor)
                                       : gauging::DecisionRule::conformance(known, probability);
}

Result<void> check_acceptance(const gauging::DecisionRule& rule, const gauging::Limits& limits) {
  if (rule.kind() != gauging::DecisionRule::Kind::Conformance ||
      gauging::guard_band_factor(limits.upper - limits.lower, rule.uncertainty(),
                                 rule.probability().value())) {
    return {};
  }
  return Error{ErrorCode::RuleNoAcceptance,
               "no value conforms with a probability of " + format(rule.probability()) +
                   ": the uncertainty of " + format_um(rule.standard_uncertainty()) +
                   " um is too large for the tolerance of " +
                   format_um(limits.upper - limits.lower) + " um"};
}

void write_verdict_members(JsonWriter& json, Length nominal_size, const MeasuredSize& measured,
                           const gauging::GaugingResult& result) {
  json.member_mm("measured_mm", measured.reading);
  if (measured.corrected) json.member_mm("corrected_mm", *measured.corrected);
  if (measured.added_uncertainty) {
    json.key("added_uncertainty_um").decimal(*measured.added_uncertainty, 6);
  }
  json.member_um("deviation_um", measured.decisive() - nominal_size)
      .member("verdict", word(result.verdict))
      .member_um("excess_um", result.excess);
}

void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule, const RuleWords& words,
                        const gauging::Limits& limits, Length measured) {
  using Kind = gauging::DecisionRule::Kind;
  if (rule.kind() == Kind::Simple) return;
  const Length u = rule.standard_uncertainty();
  json.member("rule", word(rule.kind()))
      .member_um("uncertainty_um", words.standard_uncertainty.value_or(u));
  if (words.degrees_of_freedom) {
    json.key("degrees_of_freedom").decimal(*words.degrees_of_freedom, 6);
  }
  if (rule.kind() == Kind::GuardBand) {
    json.key("coverage_factor").raw(format(rule.coverage_factor()));
    return;
  }
  json.key("probability").raw(format(rule.probability()));
  const auto figures = gauging::conformance_figures(limits, measured, rule.uncertainty(),
                                                    rule.probability().value());
  if (!figures) return;  // check_acceptance has refused it
  json.key("conformance_probability").decimal(figures->probability, 9);
  json.key("guard_band_um").decimal(figures->guard_band, 9);
}

}  // namespace fitgauge::api

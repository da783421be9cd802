#include "api/resources.hpp"

#include <fmt/format.h>

#include <functional>

#include "api/handlers.hpp"
#include "api/limits/limits_codec.hpp"
#include "record/verdict_codec.hpp"
#include "service/tables/table_catalog.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::api {
namespace {

/// @errors QueryInvalid
Result<std::optional<ThermalCorrection>> correction_of(const http::Request& request) {
  app::MeasurementFields fields;
  for (const app::MeasurementField& field : app::kThermalFields) {
    if (field.text != nullptr) {
      fields.*field.text = request.text(field.name);
    } else {
      fields.*field.number = request.integer(field.name);
    }
  }
  auto made = make_correction(fields);
  if (!made) {
    return Error{ErrorCode::QueryInvalid, made.error().message, made.error().where};
  }
  return made;
}

/// A warning of each parameter that changes nothing.
std::vector<Warning> unused_parameters(const http::Request& request, bool is_simple) {
  std::vector<Warning> warnings;
  const auto warn = [&](std::string_view name, std::string_view reason) {
    if (!request.has(name)) return;
    warnings.push_back({"query.unused", fmt::format("{} changes nothing {}", name, reason)});
  };
  const auto expands = [&request](std::string_view body) {
    return request.has(fmt::format("{}_material", body)) ||
           request.has(fmt::format("{}_expansion_um_per_m_k", body));
  };
  if (!expands("part")) {
    warn("temperature_c", "without part_material or part_expansion_um_per_m_k");
  }
  if (!expands("scale")) {
    warn("scale_temperature_c", "without scale_material or scale_expansion_um_per_m_k");
  }
  if (is_simple) warn("coverage_factor", "without rule=guard_band");
  if (!request.has("uncertainty_um")) warn("degrees_of_freedom", "without uncertainty_um");
  if (standards::is_designation(*request.text("designation"))) {
    warn("revision", "here: it is of the tables of ISO 286");
  }
  return warnings;
}

/// The limits of a designation, of whatever standard.
struct Limits {
  iso286::Feature feature = iso286::Feature::Hole;
  gauging::Quantity quantity = gauging::Quantity::Diameter;
  Length nominal;
  gauging::ConformanceLimits of;
  std::string etag;
  std::function<void(JsonWriter&)> write_members;
};

Result<Limits> limits_of(const http::Request& request, const iso286::ToleranceTables& tables) {
  const std::string_view text = *request.text("designation");
  if (standards::is_designation(text)) {
    auto limits = standards::limits_of(text);
    if (!limits) return limits.error();
    if (const auto feature = request.text("feature"); feature && limits->feature_is_open) {
      limits->feature = *iso286::feature_from_word(*feature);
    }
    const gauging::Quantity quantity = app::quantity_of(*limits);
    const bool is_distance = quantity == gauging::Quantity::Distance;
    return Limits{
        .feature = limits->feature,
        .quantity = is_distance && request.text("feature") ? gauging::Quantity::Diameter : quantity,
        .nominal = limits->nominal,
        .of = {limits->upper_limit(), limits->lower_limit()},
        .etag = etag_of(*limits->standard),
        .write_members = [limits = *limits](JsonWriter& json) {
          write_limits_members(json, limits);
        }};
  }
  const auto designation = iso286::parse_designation(text);
  if (!designation) return designation.error();
  const auto limits = tables.limits_of_size(designation->nominal_size, designation->class_name);
  if (!limits) return limits.error();
  return Limits{.feature = limits->feature,
                .nominal = limits->nominal_size.length(),
                .of = {limits->upper_limit(), limits->lower_limit()},
                .etag = etag_of(tables),
                .write_members = [limits = *limits, &tables](JsonWriter& json) {
                  write_limits_members(json, limits, tables);
                }};
}

Result<http::Response> verdict(const http::Request& request,
                               const iso286::ToleranceTables& tables) {
  const auto limits = limits_of(request, tables);
  if (!limits) return limits.error();
  if (const auto feature = request.text("feature"); feature && *feature != word(limits->feature)) {
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("{} belongs to a {}: remove feature", *request.text("designation"),
                             word(limits->feature)),
                 "feature"};
  }
  MeasuredSize measured{.reading = *request.length("measured_mm")};
  if (const auto checked = check_measured(measured.reading); !checked) return checked.error();
  const auto correction = correction_of(request);
  if (!correction) return correction.error();
  if (*correction) {
    measured.corrected = (**correction)(measured.reading);
    measured.added_uncertainty = (*correction)->added_uncertainty(*measured.corrected);
  }
  const std::optional<Length> given = request.length("uncertainty_um");
  if (given) {
    if (const auto checked = check_uncertainty(*given); !checked) return checked.error();
  }
  const auto kind = gauging::rule_from_word(request.text("rule").value_or("simple"));
  if (given && kind == gauging::DecisionRule::Kind::Simple) {
    return Error{ErrorCode::QueryUnused,
                 "rule simple does not use uncertainty_um: give rule=guard_band or "
                 "rule=conformance, or remove it",
                 "uncertainty_um"};
  }
  const RuleWords words{.kind = *kind,
                        .standard_uncertainty = given,
                        .coverage_millionths = request.integer("coverage_factor"),
                        .probability_millionths = request.integer("probability"),
                        .degrees_of_freedom = request.integer("degrees_of_freedom"),
                        .added_uncertainty = measured.added_uncertainty};
  const auto rule = make_rule(words);
  if (!rule) return rule.error();
  if (const auto checked = check_acceptance(*rule, limits->of); !checked) return checked.error();

  const auto result = gauging::gauge({limits->quantity, limits->feature}, limits->of.upper,
                                     limits->of.lower, measured.decisive(), *rule);
  std::vector<Warning> warnings =
      unused_parameters(request, rule->kind() == gauging::DecisionRule::Kind::Simple);
  warn_of_no_acceptance(*rule, limits->of.upper - limits->of.lower, warnings);
  return tagged_json(json_object([&](JsonWriter& json) {
                       limits->write_members(json);
                       write_verdict_members(json, limits->nominal, measured, result);
                       write_rule_members(json, *rule, words, limits->of, measured.decisive());
                       write_warnings(json, warnings);
                     }),
                     limits->etag);
}

/// A field of a measurement as a parameter.
http::Parameter parameter_of(const app::MeasurementField& field) {
  http::Parameter parameter{.name = std::string(field.name),
                            .description = std::string(field.meaning)};
  if (field.number != nullptr) {
    parameter.type = http::Decimal{
        .scale = field.scale, .min = field.accepted.least, .max = field.accepted.most};
    return parameter;
  }
  http::Words words;
  for (const gauging::Material& known : gauging::materials()) words.words.emplace_back(known.name);
  parameter.type = std::move(words);
  return parameter;
}

}  // namespace

void add_verdicts_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/verdicts/{designation}",
      .handler =
          [&tables = services.tables](const http::Request& request, http::Responder responder) {
            tables_of(tables, request,
                      [&request, answer = answer_by(share(std::move(responder)))](
                          const Result<app::TableCatalog::Tables>& found) {
                        answer(found ? verdict(request, **found) : found.error());
                      });
          },
      .summary = "Verdict on a measured value",
      .description =
          "good, rework (hole too small, shaft too large) or reject (hole too large, shaft too "
          "small); limits are inclusive. Nothing is stored.",
      .parameters = {path_parameter("designation", "25H7, M10-6H, 25 ISO 2768-m"),
                     {.name = "feature",
                      .type = http::Words{{"hole", "shaft"}},
                      .description = "Of a general tolerance, which does not say it: a distance, "
                                     "whose rejects are on both sides, when absent"},
                     {.name = "measured_mm",
                      .type = http::LengthIn{.round_to_nearest = true},
                      .required = true,
                      .description = "Measured value, 0 < m <= 100000000; rounded to 1 nm"},
                     {.name = "rule",
                      .type = http::Words{{"simple", "guard_band", "conformance"}},
                      .description = "Decision rule (ISO 14253-1); simple when absent"},
                     {.name = "uncertainty_um",
                      .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                      .description = "u; required by guard_band and conformance"},
                     {.name = "coverage_factor",
                      .type = http::Decimal{.scale = 6, .min = 1, .max = 100'000'000},
                      .description = "k of guard_band; t(0.9545, degrees_of_freedom) when absent, "
                                     "2 without them"},
                     {.name = "degrees_of_freedom",
                      .type = http::Decimal{.scale = 6,
                                            .min = app::kDegreesOfFreedom.least,
                                            .max = app::kDegreesOfFreedom.most},
                      .description = "Of uncertainty_um; without end when absent"},
                     {.name = "probability",
                      .type = http::Decimal{.scale = 6, .min = 500'000, .max = 999'999},
                      .description = "Of conformance, at least 0.5; 0.95 when absent"},
                     revision_parameter()},
      .access = "open",
      .operation = "getVerdict",
      .outcomes = {{.meaning = "The verdict", .schema = "Verdict"}},
      .refusals = {404, 422},
  });
  for (const app::MeasurementField& field : app::kThermalFields) {
    routes.back().parameters.push_back(parameter_of(field));
  }
}

}  // namespace fitgauge::api

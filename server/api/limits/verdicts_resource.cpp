#include "api/limits/verdicts_resource.hpp"

#include "api/limits/limits_codec.hpp"
#include "api/limits/thermal_codec.hpp"
#include "api/limits/verdict_codec.hpp"
#include "app/tables/table_catalog.hpp"
#include "iso286/designation.hpp"

namespace fitgauge::api {
namespace {

/// @errors QueryInvalid
Result<std::optional<ThermalCorrection>> correction_of(const http::Request& request) {
  auto made = make_correction({.temperature = request.integer("temperature_c"),
                               .scale_temperature = request.integer("scale_temperature_c"),
                               .part_expansion = request.integer("part_expansion_um_per_m_k"),
                               .scale_expansion = request.integer("scale_expansion_um_per_m_k"),
                               .part_material = request.text("part_material"),
                               .scale_material = request.text("scale_material")});
  if (!made) {
    return Error{ErrorCode::QueryInvalid, made.error().message, made.error().where};
  }
  return made;
}

Result<http::Response> verdict(const http::Request& request,
                               const iso286::ToleranceTables& tables) {
  const auto designation = iso286::parse_designation(*request.text("designation"));
  if (!designation) return designation.error();
  const auto limits = tables.limits_of_size(designation->nominal_size, designation->class_name);
  if (!limits) return limits.error();
  MeasuredSize measured{.reading = *request.length("measured_mm")};
  if (const auto checked = check_measured(measured.reading); !checked) return checked.error();
  const auto correction = correction_of(request);
  if (!correction) return correction.error();
  if (*correction) measured.corrected = (**correction)(measured.reading);
  const auto kind = gauging::rule_from_word(request.text("rule").value_or("simple"));
  const auto rule = make_rule({.kind = *kind,
                               .standard_uncertainty = request.length("uncertainty_um"),
                               .coverage_millionths = request.integer("coverage_factor"),
                               .probability_millionths = request.integer("probability")});
  if (!rule) return rule.error();
  const gauging::ConformanceLimits of{limits->upper_limit(), limits->lower_limit()};
  if (const auto checked = check_acceptance(*rule, of); !checked) return checked.error();

  const auto result = gauging::gauge(limits->feature, limits->upper_limit(), limits->lower_limit(),
                                     measured.decisive(), *rule);
  std::string body;
  JsonWriter json(body);
  json.begin_object();
  write_limits_members(json, *limits, tables);
  write_verdict_members(json, limits->nominal_size.length(), measured, result);
  write_rule_members(json, *rule, of, measured.decisive());
  json.end_object();
  http::Response response(200, "application/json", std::move(body));
  response.etag = etag_of(tables);
  return response;
}

http::Parameter temperature(std::string name, std::string description) {
  return {.name = std::move(name),
          .type = http::Decimal{.min = gauging::kColdest, .max = gauging::kHottest},
          .description = std::move(description)};
}

http::Parameter expansion(std::string name, std::string description) {
  return {.name = std::move(name),
          .type = http::Decimal{.min = 0, .max = gauging::kLargestExpansion},
          .description = std::move(description)};
}

http::Parameter material(std::string name, std::string description) {
  http::Words words;
  for (const gauging::Material& known : gauging::materials()) words.words.emplace_back(known.name);
  return {.name = std::move(name), .type = std::move(words), .description = std::move(description)};
}

}  // namespace

void add_verdicts_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/verdicts/{designation}",
      .handler = [&tables =
                      services.tables](const http::Request& request) -> Result<http::Response> {
        const auto current = tables.tables();
        if (!current) return current.error();
        return verdict(request, **current);
      },
      .summary = "Verdict on a measured value",
      .description =
          "good, rework (hole too small, shaft too large) or reject (hole too large, shaft too "
          "small); limits are inclusive. Nothing is stored.",
      .parameters = {{.name = "designation",
                      .place = http::ParameterPlace::Path,
                      .description = "Size and class: 25H7"},
                     {.name = "measured_mm",
                      .type = http::LengthIn{.round_to_nearest = true},
                      .required = true,
                      .description = "Measured value, 0 < m <= 100000000; rounded to 1 nm"},
                     {.name = "rule",
                      .type = http::Words{{"simple", "guard_band", "conformance"}},
                      .description = "Decision rule (ISO 14253-1); simple when absent"},
                     {.name = "uncertainty_um",
                      .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                      .description =
                          "Standard uncertainty u; required by guard_band and conformance"},
                     {.name = "coverage_factor",
                      .type = http::Decimal{.scale = 6, .min = 1, .max = 100'000'000},
                      .description = "k of guard_band; 2 when absent"},
                     {.name = "probability",
                      .type = http::Decimal{.scale = 6, .min = 500'000, .max = 999'999},
                      .description = "Of conformance, at least 0.5; 0.95 when absent"},
                     temperature("temperature_c", "Of the part; corrects with an expansion"),
                     temperature("scale_temperature_c", "Of what it was read on; else 20"),
                     expansion("part_expansion_um_per_m_k", "Of the part: 11.5 of steel"),
                     expansion("scale_expansion_um_per_m_k", "Of the scale"),
                     material("part_material", "Instead of part_expansion_um_per_m_k"),
                     material("scale_material", "Instead of scale_expansion_um_per_m_k")},
      .access = "open",
      .operation = "getVerdict",
      .tag = "limits",
      .outcomes = {{.meaning = "The verdict", .schema = "Verdict"}},
      .refusals = {404, 422},
  });
}

}  // namespace fitgauge::api

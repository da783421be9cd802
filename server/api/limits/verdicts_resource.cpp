#include "api/limits/verdicts_resource.hpp"

#include "api/limits/limits_codec.hpp"
#include "api/limits/verdict_codec.hpp"
#include "app/tables/table_catalog.hpp"
#include "iso286/designation.hpp"

namespace fitgauge::api {
namespace {

Result<http::Response> verdict(const http::Request& request,
                               const iso286::ToleranceTables& tables) {
  const auto designation = iso286::parse_designation(*request.text("designation"));
  if (!designation) return designation.error();
  const auto limits = tables.limits_of_size(designation->nominal_size, designation->class_name);
  if (!limits) return limits.error();
  const Length measured = *request.length("measured_mm");
  if (const auto checked = check_measured(measured); !checked) return checked.error();
  const auto kind = gauging::rule_from_word(request.text("rule").value_or("simple"));
  const auto rule =
      make_rule(*kind, request.length("uncertainty_um"), request.integer("coverage_factor"));
  if (!rule) return rule.error();

  const auto result = gauging::gauge(limits->feature, limits->upper_limit(), limits->lower_limit(),
                                     measured, *rule);
  std::string body;
  JsonWriter json(body);
  json.begin_object();
  write_limits_members(json, *limits, tables);
  write_verdict_members(json, limits->nominal_size.length(), measured, result);
  write_rule_members(json, *rule);
  json.end_object();
  http::Response response(200, "application/json", std::move(body));
  response.etag = etag_of(tables);
  return response;
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
                      .type = http::Words{{"simple", "guard_band"}},
                      .description = "Decision rule (ISO 14253-1); simple when absent"},
                     {.name = "uncertainty_um",
                      .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                      .description = "Standard uncertainty u; required by guard_band"},
                     {.name = "coverage_factor",
                      .type = http::Decimal{.scale = 6, .min = 1, .max = 100'000'000},
                      .description = "k; 2 when absent"}},
      .access = "open",
      .operation = "getVerdict",
      .tag = "limits",
      .outcomes = {{.meaning = "The verdict", .schema = "Verdict"}},
      .refusals = {404, 422},
  });
}

}  // namespace fitgauge::api

#include "api/resources.hpp"

#include <fmt/format.h>

#include "api/limits/limits_codec.hpp"
#include "api/statistics/computation.hpp"
#include "api/wire/formulas.hpp"
#include "base/json/field_reader.hpp"
#include "metrology/statistics/limit_gauge.hpp"
#include "metrology/statistics/press_fit.hpp"
#include "tables/iso286/designation.hpp"

namespace fitgauge::api {
namespace {

Result<http::Response> gauge(const http::Request& request, const iso286::ToleranceTables& tables) {
  const auto designation = iso286::parse_designation(*request.text("designation"));
  if (!designation) return designation.error();
  const auto limits = tables.limits_of_size(designation->nominal_size, designation->class_name);
  if (!limits) return limits.error();
  const auto made = metrology::limit_gauge(*limits, designation->class_name);
  if (!made) return made.error();

  const auto designation_of =
      designation_text(designation->nominal_size.length(), designation->class_name);
  std::string body;
  JsonWriter json(body);
  const std::string_view kind = limits->feature == iso286::Feature::Hole ? "plug" : "ring or snap";
  json.begin_object().member("designation", designation_of);
  write_formula(json, kind);
  json.member("scheme", metrology::kLimitGaugeScheme)
      .member("note", "the tables of the later editions, ISO 1938-1:2015 and 2026, are not public")
      .member("kind", kind)
      .member_mm("upper_limit_mm", limits->upper_limit())
      .member_mm("lower_limit_mm", limits->lower_limit())
      .key("go")
      .begin_object()
      .member_mm("upper_mm", made->go.upper)
      .member_mm("lower_mm", made->go.lower)
      .member_mm("wear_limit_mm", made->go_wear_limit)
      .end_object()
      .key("no_go")
      .begin_object()
      .member_mm("upper_mm", made->no_go.upper)
      .member_mm("lower_mm", made->no_go.lower)
      .end_object()
      .end_object();
  http::Response response(200, "application/json", std::move(body));
  response.etag = etag_of(tables);
  return response;
}

double positive(FieldReader& fields, std::string_view name, double fallback, bool or_zero = false) {
  const double value = fields.number_or(name, fallback);
  constexpr double kMost = 1e9;
  if ((value > 0 || (or_zero && value == 0)) && value <= kMost) return value;
  fields.report(ErrorCode::FieldInvalid, name,
                fmt::format("{} is {} 0 and at most 1e9", name, or_zero ? "at least" : "above"));
  return fallback;
}

metrology::PressedPart read_part(FieldReader& fields, std::string_view name,
                                 std::string_view diameter, FieldErrors& errors) {
  metrology::PressedPart part;
  const JsonValue* object = fields.object(name);
  if (object == nullptr) return part;
  FieldReader own(*object, fields.at(name), errors);
  const bool solid_allowed = diameter == "inner_diameter_mm";
  if (!solid_allowed && !own.has(diameter)) own.number(diameter);
  part.other_diameter_mm = positive(own, diameter, 0, solid_allowed || !own.has(diameter));
  part.youngs_modulus_mpa = positive(own, "youngs_modulus_mpa", part.youngs_modulus_mpa);
  part.poisson_ratio = own.number_or("poisson_ratio", part.poisson_ratio);
  if (!(part.poisson_ratio >= 0 && part.poisson_ratio <= 0.5)) {
    own.report(ErrorCode::FieldInvalid, "poisson_ratio", "poisson_ratio lies from 0 to 0.5");
  }
  part.rz_um = positive(own, "rz_um", 0, true);
  own.refuse_unknown();
  return part;
}

Result<std::string> press_fit(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  metrology::PressFit fit;
  if (!fields.has("joint_diameter_mm")) fields.number("joint_diameter_mm");
  fit.joint_diameter_mm = positive(fields, "joint_diameter_mm", 1);
  if (!fields.has("length_mm")) fields.number("length_mm");
  fit.length_mm = positive(fields, "length_mm", 1);
  fit.friction = positive(fields, "friction", fit.friction);
  fit.hub = read_part(fields, "hub", "outer_diameter_mm", errors);
  fit.shaft = read_part(fields, "shaft", "inner_diameter_mm", errors);
  const double least = positive(fields, "min_interference_um", 0, true);
  if (!fields.has("max_interference_um")) fields.number("max_interference_um");
  const double most = positive(fields, "max_interference_um", 0, true);
  if (least > most) {
    fields.report(ErrorCode::FieldInvalid, "min_interference_um",
                  "min_interference_um is above max_interference_um");
  }
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  std::string out;
  JsonWriter json(out);
  json.begin_object().member("method", "Lame, DIN 7190-1:2017, elastic, plane stress");
  write_formula(json, "press_fit");
  for (const auto& [name, interference] :
       {std::pair{"at_min_interference", least}, std::pair{"at_max_interference", most}}) {
    const auto made = metrology::press(fit, interference);
    if (!made) {
      errors.add(made.error().code, "/hub", made.error().message);
      return *errors.take();
    }
    json.key(name)
        .begin_object()
        .member("interference_um", interference)
        .member("effective_interference_um", made->effective_um)
        .member("pressure_mpa", made->pressure_mpa)
        .member("hub_stress_mpa", made->hub_stress_mpa)
        .member("shaft_stress_mpa", made->shaft_stress_mpa)
        .member("axial_force_n", made->axial_force_n)
        .member("torque_nm", made->torque_nm)
        .end_object();
  }
  json.end_object();
  return out;
}

}  // namespace

void add_gauges_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache) {
  routes.push_back({
      .pattern = "/v1/gauges/{designation}",
      .handler = ResponseCache::cached(cache, gauge),
      .summary = "GO and NO-GO sizes of the limit gauges of a designation",
      .description = "New and worn, by ISO/R 1938:1971: holes of IT6 to IT16, shafts of IT5 to "
                     "IT16, up to 500 mm.",
      .parameters = {{.name = "designation",
                      .place = http::ParameterPlace::Path,
                      .description = "Size and class: 25H7"}},
      .access = "open",
      .operation = "getLimitGauge",
      .tag = "limits",
      .outcomes = {{.meaning = "The gauges", .schema = "LimitGauge"}},
      .refusals = {404, 422},
  });
}

void add_press_fits_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back(route_of(services, {.pattern = "/v1/press-fits",
                                       .compute = press_fit,
                                       .summary = "Pressure, stress and slip of a press fit",
                                       .operation = "computePressFit",
                                       .tag = "limits",
                                       .reads = "PressFitOrder",
                                       .answers = "PressFit"}));
}

}  // namespace fitgauge::api

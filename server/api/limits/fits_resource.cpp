#include "api/limits/fits_resource.hpp"

#include <algorithm>

#include "api/limits/limits_codec.hpp"
#include "iso286/designation.hpp"
#include "metrology/fit_analysis.hpp"

namespace fitgauge::api {
namespace {

using iso286::ToleranceTables;

/// How likely sizes in the middle of their tolerances interfere; worst case stands beside it.
void write_statistical(JsonWriter& json, const iso286::Fit& fit) {
  const metrology::FitProbabilities found = metrology::probability_of_interference(fit);
  json.key("statistical").begin_object();
  json.key("normal").begin_object();
  json.member("probability_of_interference", found.normal).end_object();
  json.key("uniform").begin_object();
  json.member("probability_of_interference", found.uniform).end_object().end_object();
}

std::string fit_designation(Length nominal_size, std::string_view hole, std::string_view shaft) {
  std::string text = designation_text(nominal_size, hole);
  text += '/';
  return text += shaft;
}

void write_fit_members(JsonWriter& json, const iso286::Fit& fit, std::string_view designation,
                       const ToleranceTables& tables) {
  json.member("designation", designation).key("hole");
  write_limits(json, fit.hole, tables);
  json.key("shaft");
  write_limits(json, fit.shaft, tables);
  json.member("type", word(fit.kind()))
      .member_um("max_clearance_um", fit.max_clearance())
      .member_um("min_clearance_um", fit.min_clearance());
  write_statistical(json, fit);
}

Result<http::Response> fit_response(const iso286::FitDesignation& designation,
                                    const ToleranceTables& tables) {
  const auto hole = tables.find_class(designation.hole_class);
  if (!hole) return hole.error();
  const auto shaft = tables.find_class(designation.shaft_class);
  if (!shaft) return shaft.error();
  const auto fit = tables.fit(designation.nominal_size, *hole, *shaft);
  if (!fit) return fit.error();

  std::string body;
  JsonWriter json(body);
  json.begin_object();
  write_fit_members(json, *fit,
                    fit_designation(designation.nominal_size.length(), designation.hole_class,
                                    designation.shaft_class),
                    tables);
  json.end_object();
  http::Response response(200, "application/json", std::move(body));
  response.etag = etag_of(tables);
  return response;
}

Result<http::Response> fit_of_two_segments(const http::Request& request,
                                           const ToleranceTables& tables) {
  const auto designation =
      iso286::parse_fit_designation(*request.text("hole"), *request.text("shaft"));
  if (!designation) return designation.error();
  return fit_response(*designation, tables);
}

Result<http::Response> fit_of_one_segment(const http::Request& request,
                                          const ToleranceTables& tables) {
  const auto designation = iso286::parse_fit_designation(*request.text("fit"));
  if (!designation) return designation.error();
  return fit_response(*designation, tables);
}

/// The fit as its own address answers it, with the names of its classes.
Result<void> write_found(JsonWriter& json, const metrology::FoundFit& found,
                         iso286::NominalSize size, const ToleranceTables& tables) {
  const auto fit = tables.fit(size, found.hole, found.shaft);
  if (!fit) return fit.error();
  const std::string_view hole = tables.class_name(found.hole);
  const std::string_view shaft = tables.class_name(found.shaft);
  json.begin_object();
  write_fit_members(json, *fit, fit_designation(size.length(), hole, shaft), tables);
  json.member("hole_class", hole)
      .member("shaft_class", shaft)
      .member("preferred", found.preferred)
      .end_object();
  return {};
}

Result<http::Response> search_fits(const http::Request& request, const ToleranceTables& tables) {
  const auto size = iso286::NominalSize::make(*request.length("nominal_mm"));
  if (!size) return size.error();
  const metrology::ClearanceBounds bounds{.least = *request.length("min_clearance_um"),
                                          .most = *request.length("max_clearance_um")};
  if (bounds.least > bounds.most) {
    return Error{ErrorCode::QueryInvalid, "min_clearance_um is above max_clearance_um"};
  }
  constexpr std::int64_t kUsual = 100;
  const auto limit = static_cast<std::size_t>(request.integer("limit").value_or(kUsual));
  const auto found = metrology::find_fits(tables, *size, bounds);
  std::string body;
  JsonWriter json(body);
  json.begin_object().key("fits").begin_array();
  for (std::size_t i = 0; i < std::min(limit, found.size()); ++i) {
    if (const auto written = write_found(json, found[i], *size, tables); !written) {
      return written.error();
    }
  }
  json.end_array().member("total", std::uint64_t{found.size()}).end_object();
  http::Response response(200, "application/json", std::move(body));
  response.etag = etag_of(tables);
  return response;
}

}  // namespace

void add_fits_routes(std::vector<http::Route>& routes,
                     const std::shared_ptr<ResponseCache>& cache) {
  routes.push_back({
      .pattern = "/v1/fits/{hole}/{shaft}",
      .handler = ResponseCache::cached(cache, fit_of_two_segments),
      .summary = "Fit of a hole and a shaft",
      .description = "Limits of both and the clearances; interference is negative clearance.",
      .parameters = {{.name = "hole",
                      .place = http::ParameterPlace::Path,
                      .description = "Size and class of the hole: 25H7"},
                     {.name = "shaft",
                      .place = http::ParameterPlace::Path,
                      .description = "Class of the shaft: g6"}},
      .access = "open",
      .operation = "getFit",
      .tag = "limits",
      .outcomes = {{.meaning = "The fit", .schema = "Fit"}},
      .refusals = {404, 422},
  });
  routes.push_back({
      .pattern = "/v1/fits/{fit}",
      .handler = ResponseCache::cached(cache, fit_of_one_segment),
      .summary = "Fit of a hole and a shaft, written as one",
      .description = "The same with an encoded stroke: 25H7%2Fg6.",
      .parameters = {{.name = "fit",
                      .place = http::ParameterPlace::Path,
                      .description = "25H7/g6, the stroke percent-encoded"}},
      .access = "open",
      .operation = "getFitAsOne",
      .tag = "limits",
      .outcomes = {{.meaning = "The fit", .schema = "Fit"}},
      .refusals = {404, 422},
  });
  routes.push_back({
      .pattern = "/v1/fits",
      .handler = ResponseCache::cached(cache, search_fits),
      .summary = "Fits whose clearances lie within bounds",
      .description =
          "The preferred fits of ISO 286-1 (hole basis) first, then the widest tolerances.",
      .parameters = {{.name = "nominal_mm",
                      .type = http::LengthIn{},
                      .required = true,
                      .description = "Nominal size, 0 < D <= 3150"},
                     {.name = "min_clearance_um",
                      .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                      .required = true,
                      .description = "Least clearance allowed; interference is negative"},
                     {.name = "max_clearance_um",
                      .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                      .required = true,
                      .description = "Greatest clearance allowed"},
                     {.name = "limit",
                      .type = http::Integer{.min = 1, .max = 1000},
                      .description = "Most fits in the answer, 1 to 1000; 100 when absent"}},
      .access = "open",
      .operation = "findFits",
      .tag = "limits",
      .outcomes = {{.meaning = "The fits found", .schema = "FoundFits"}},
      .refusals = {422},
  });
}

}  // namespace fitgauge::api

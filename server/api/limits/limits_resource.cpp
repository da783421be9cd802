#include "api/resources.hpp"

#include "api/limits/limits_codec.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::api {
namespace {

using iso286::ToleranceTables;

Result<http::Response> limits_response(iso286::NominalSize size, std::string_view class_name,
                                       const ToleranceTables& tables) {
  const auto limits = tables.limits_of_size(size, class_name);
  if (!limits) return limits.error();
  return tagged_json(
      json_object([&](JsonWriter& json) { write_limits_members(json, *limits, tables); }),
      etag_of(tables));
}

Result<http::Response> limits_response(const Result<standards::DesignatedLimits>& limits) {
  if (!limits) return limits.error();
  return tagged_json(json_object([&](JsonWriter& json) { write_limits_members(json, *limits); }),
                     etag_of(*limits->standard));
}

Result<http::Response> limits_of_designation(const http::Request& request,
                                             const ToleranceTables& tables) {
  const std::string_view text = *request.text("designation");
  if (standards::is_designation(text)) return limits_response(standards::limits_of(text));
  const auto designation = iso286::parse_designation(*request.text("designation"));
  if (!designation) return designation.error();
  return limits_response(designation->nominal_size, designation->class_name, tables);
}

Result<http::Response> limits_of_query(const http::Request& request,
                                       const ToleranceTables& tables) {
  if (const auto name = *request.text("tolerance_class"); standards::is_class(name)) {
    return limits_response(standards::limits_of(*request.length("nominal_mm"), name));
  }
  const auto size = iso286::NominalSize::make(*request.length("nominal_mm"));
  if (!size) return size.error();
  return limits_response(*size, *request.text("tolerance_class"), tables);
}

}  // namespace

void add_limits_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache) {
  routes.push_back({
      .pattern = "/v1/limits/{designation}",
      .handler = ResponseCache::of_revision(cache, limits_of_designation),
      .summary = "Limits of size of a designation",
      .description = "Deviations and limits of a nominal size and tolerance class (ISO 286-1), of "
                     "the pitch diameter of a thread (ISO 965-1), of a general tolerance "
                     "(ISO 2768-1).",
      .parameters = {path_parameter("designation",
                                    "25H7, 25 H7, Ø25H7; M10-6H, M10x1.25-6g; 25 ISO 2768-m, "
                                    "R2 ISO 2768-m; a comma may mark decimals"),
                     revision_parameter()},
      .access = "open",
      .operation = "getLimits",
      .outcomes = {{.meaning = "The limits", .schema = "Limits"}},
      .refusals = {404, 422},
  });
  routes.push_back({
      .pattern = "/v1/limits",
      .handler = ResponseCache::of_revision(cache, limits_of_query),
      .summary = "Limits of size of a nominal size and a tolerance class",
      .parameters = {{.name = "nominal_mm",
                      .type = http::LengthIn{},
                      .required = true,
                      .description = "Nominal size, 0 < D <= 3150"},
                     {.name = "tolerance_class",
                      .required = true,
                      .description = "H7, g6, ISO 2768-m or a custom tolerance class"},
                     revision_parameter()},
      .access = "open",
      .operation = "findLimits",
      .outcomes = {{.meaning = "The limits", .schema = "Limits"}},
      .refusals = {404, 422},
  });
}

}  // namespace fitgauge::api

#pragma once

#include <string>
#include <vector>

#include "api/services.hpp"
#include "base/json/json_value.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// The answer to a budget. @errors RequestInvalid with every bad field.
Result<std::string> compute_uncertainty(const JsonValue& body);

/// /v1/uncertainty: an uncertainty budget, computed and not stored.
void add_uncertainty_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <string>
#include <vector>

#include "http/route.hpp"

namespace fitgauge::api {

/// The OpenAPI 3.1 document of the routes.
std::string openapi_json(const std::vector<http::Route>& routes);

/// Adds GET /openapi.json, which describes the routes before it and itself.
void add_openapi_route(std::vector<http::Route>& routes);

}  // namespace fitgauge::api

#pragma once

#include <string>
#include <vector>

#include "base/json/schema.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// Gives each schema that has none an example, made of its members and of the examples it names.
void add_examples(Schemas& schemas);

/// The OpenAPI 3.1 document of the routes. @param of_plant as make_schemas
std::string openapi_json(const std::vector<http::Route>& routes, const Schemas& of_plant);

/// Adds GET /openapi.json, which describes the routes before it and itself.
void add_openapi_route(std::vector<http::Route>& routes, const Schemas& of_plant);

}  // namespace fitgauge::api

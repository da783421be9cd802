#pragma once

#include <vector>

#include "api/services.hpp"
#include "base/json/schema.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// Every operation of the service. /openapi.json is made from the others.
/// @param services outlive the routes.
/// @param of_plant, schemas the routes and the components of the rooms above
http::RouteTable make_routes(const Services& services, std::vector<http::Route> of_plant,
                             const Schemas& schemas);

}  // namespace fitgauge::api

#pragma once

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// Every operation of the service. /openapi.json is made from the others.
/// @param services outlive the routes.
http::RouteTable make_routes(const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /livez, /readyz and /metrics.
void add_service_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/measurements: judges and stores, reads one, lists, sums up.
void add_measurements_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

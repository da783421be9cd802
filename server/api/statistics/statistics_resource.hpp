#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/statistics: figures of values that are sent; nothing is stored.
void add_statistics_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

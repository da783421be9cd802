#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// GET /v1/measurements/{capability,chart}: figures of stored values.
void add_stored_statistics_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/uncertainty: an uncertainty budget, computed and not stored.
void add_uncertainty_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

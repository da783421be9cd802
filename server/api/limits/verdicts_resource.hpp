#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/verdicts: judges a measured value and stores nothing.
void add_verdicts_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

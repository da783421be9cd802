#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/log and the proof of a measurement.
void add_log_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

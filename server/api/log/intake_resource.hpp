#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/log/{origin}/{from}: what stations forward.
void add_intake_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// @param services outlive the routes.
void add_plans_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

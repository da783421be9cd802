#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

void add_connections_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

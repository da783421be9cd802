#pragma once

#include <vector>

#include "http/route.hpp"

namespace fitgauge::api {

void add_cycles_routes(std::vector<http::Route>& routes);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// What a centre hands on to its stations.
void add_revisions_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/uncertainties and /v1/gauges-in-use: budgets and gauges that are kept under a name.
void add_documents_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <memory>
#include <vector>

#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/limits: the limits of size of one designation.
void add_limits_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache);

}  // namespace fitgauge::api

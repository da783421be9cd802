#pragma once

#include <memory>
#include <vector>

#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// GET /v1/standards and /v1/standards/{name}: the numbers of the standards beside ISO 286.
void add_standards_routes(std::vector<http::Route>& routes,
                          const std::shared_ptr<ResponseCache>& cache);

}  // namespace fitgauge::api

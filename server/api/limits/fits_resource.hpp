#pragma once

#include <memory>
#include <vector>

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/fits: a hole and a shaft of one nominal size, and the search for such.
void add_fits_routes(std::vector<http::Route>& routes, const Services& services,
                     const std::shared_ptr<ResponseCache>& cache);

}  // namespace fitgauge::api

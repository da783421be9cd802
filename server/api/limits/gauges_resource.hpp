#pragma once

#include <memory>
#include <vector>

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/gauges: sizes of GO and NO-GO gauges.
void add_gauges_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache);

/// /v1/press-fits: the pressure of an interference.
void add_press_fits_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

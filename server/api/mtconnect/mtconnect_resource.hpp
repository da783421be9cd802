#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /mtconnect/probe, current and sample. Nothing runs for them: they read the log.
void add_mtconnect_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// GET /v1/events: what happens, as Server-Sent Events.
void add_events_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

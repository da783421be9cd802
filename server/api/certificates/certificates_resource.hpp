#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// GET /v1/certificates: what was measured at an order or a part, on paper or as JSON.
void add_certificates_routes(std::vector<http::Route>& routes, const Services& services);

}  // namespace fitgauge::api

#pragma once

#include "api/resources.hpp"

namespace fitgauge::api {

/// /mtconnect/probe, current, sample, assets and asset. Nothing runs for them: they read the log.
void add_mtconnect_routes(Routes& add);

/// Whether an error of the request is returned as an MTConnect document.
bool is_of_mtconnect(const http::Request& request);
/// Returns a problem as an MTConnectError document. @param problem as others get it
http::Response mtconnect_error(const Services& services, const Error& error,
                               http::Response problem);

}  // namespace fitgauge::api

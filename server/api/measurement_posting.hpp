#pragma once

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// POST /v1/measurements: an idempotent repeat is answered from the store; otherwise the body is
/// read, judged and recorded, and answered when it is durable.
void post_measurements(const Services& services, const http::Request& request,
                       http::Responder responder);

}  // namespace fitgauge::api

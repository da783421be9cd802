#pragma once

#include "api/services.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// POST /v1/measurements/{id}/corrections: stores a measurement that takes the place of another and
/// says why. What the body leaves open is taken over, limits as they were applied.
void post_correction(const Services& services, const http::Request& request,
                     http::Responder responder);

}  // namespace fitgauge::api

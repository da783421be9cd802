#pragma once

#include "api/services.hpp"
#include "http/request.hpp"
#include "http/response.hpp"

namespace fitgauge::api {

/// POST /v1/runs: checks the order, starts the run and answers with its end, or at once where
/// `Prefer: respond-async` asks for it.
void post_run(const Services& services, const http::Request& request, http::Responder responder);

}  // namespace fitgauge::api

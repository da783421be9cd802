#pragma once

#include <memory>
#include <optional>

#include "api/services.hpp"
#include "http/route.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// Everything one POST needs until it is answered. The request lives as long as its responder.
struct Posting {
  const Services& services;
  const http::Request& request;
  http::Responder responder;
  std::optional<app::IdempotencyScope> scope{};  ///< of its Idempotency-Key
};
using SharedPosting = std::shared_ptr<Posting>;

/// The header of a route that answers a repeat as it did the first time.
http::Parameter idempotency_parameter();

/// @returns null when the Idempotency-Key is no key: that has been answered.
SharedPosting begin_posting(const Services& services, const http::Request& request,
                            http::Responder responder);

http::Response response_of(app::Answer answer);
/// The same for a repeat, from what was kept.
http::Response replayed(app::Answer kept);

}  // namespace fitgauge::api

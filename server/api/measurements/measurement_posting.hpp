#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "api/measurements/measurement_batch.hpp"
#include "api/services.hpp"
#include "app/measurements/measurement_service.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// Everything one POST needs until it is answered. The request lives as long as its responder.
struct Posting {
  const Services& services;
  const http::Request& request;
  http::Responder responder;
  std::optional<app::IdempotencyScope> scope{};
};

using SharedPosting = std::shared_ptr<Posting>;

/// Answers a repeat of an idempotent request from the store; otherwise goes on with `first_time`,
/// on this thread or on a reader's.
void post_once(const Services& services, const http::Request& request, http::Responder responder,
               std::function<void(const SharedPosting&)> first_time);

/// Records a batch and answers when it is durable.
void record(const SharedPosting& posting, MeasurementBatch batch);

/// POST /v1/measurements: reads the body, judges its rows and records them.
void post_measurements(const Services& services, const http::Request& request,
                       http::Responder responder);

}  // namespace fitgauge::api

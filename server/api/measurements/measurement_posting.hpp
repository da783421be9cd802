#pragma once

#include <functional>

#include "api/posting.hpp"
#include "record/measurement_batch.hpp"

namespace fitgauge::api {

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

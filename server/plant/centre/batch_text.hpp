#pragma once

#include <string>

#include "service/log/log_outbox.hpp"

namespace fitgauge::forwarder {

/// The body of `PUT /v1/log/{origin}/{from}`, as api::read_batch() reads it.
std::string batch_text(const app::LogOutbox::Batch& batch);

}  // namespace fitgauge::forwarder

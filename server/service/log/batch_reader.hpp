#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "base/json/text_arena.hpp"
#include "base/result.hpp"
#include "service/log/log_intake.hpp"

namespace fitgauge::api {

/// A batch and the texts its rows have views of, beside those of the body.
struct ReadBatch {
  app::ForwardedBatch batch;
  TextArena texts;
};

/// Reads the body of `PUT /v1/log/{origin}/{from}`, which outlives the batch.
/// @errors LogRecordInvalid and those of JSON, each with the line; RequestInvalid.
Result<std::unique_ptr<ReadBatch>> read_batch(std::string_view origin, std::int64_t from,
                                              std::string_view body);

}  // namespace fitgauge::api

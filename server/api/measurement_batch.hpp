#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "app/measurement.hpp"

namespace fitgauge::api {

/// The judged measurements of one request. Their texts are views of the body and of `texts`.
struct MeasurementBatch {
  std::vector<app::Measurement> rows;
  bool single = false;                ///< the body was one object, not a list
  std::shared_ptr<const void> texts;  ///< keeps what had to be copied out of the body
};

/// What a batch is decoded with.
struct BatchContext {
  const iso286::ToleranceTables& tables;
  Timestamp received_at;
  std::optional<std::string_view> caller{};  ///< of every row; outlives the batch
};

/// The most rows one request may have.
inline constexpr std::size_t kMostRows = 100'000;

/// Reads and judges the rows of a body, all or none.
/// @param body followed by http::Request::kBodyPadding readable bytes; outlives the batch.
/// @param media_type application/json (one object or an array), application/x-ndjson or text/csv.
/// @errors JsonMalformed, JsonDuplicateKey, JsonTooDeep, TextEncoding, CsvMalformed; RequestInvalid
///   with every bad field.
Result<MeasurementBatch> decode_measurements(std::string_view body, std::string_view media_type,
                                             const BatchContext& context);

}  // namespace fitgauge::api

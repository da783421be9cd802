#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/json/text_arena.hpp"
#include "record/gauge_book.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

class FieldErrors;

/// The judged measurements of one request. Their texts are views of the body and of `texts`.
struct MeasurementBatch {
  std::vector<app::Measurement> rows{};
  bool single = false;                  ///< the body was one object, not a list
  std::shared_ptr<const void> texts{};  ///< keeps what had to be copied out of the body
  bool is_begun = false;                ///< BatchContext::take has rows before these
  /// The fast reader had delivered rows before it met an error or an escaped key. The caller
  /// discards them and decodes the whole body without `take`.
  bool wants_whole = false;
  bool has_too_many = false;  ///< more than kMostRows

  /// Keeps a text that the body has in another form.
  std::string_view keep(std::string_view text) {
    if (!decoded_texts) {
      decoded_texts = std::make_shared<TextArena>();
      texts = decoded_texts;
    }
    return decoded_texts->keep(text);
  }
  std::shared_ptr<TextArena> decoded_texts{};  ///< of keep()
};

/// What a batch is decoded with. All of it outlives the batch.
struct BatchContext {
  const iso286::ToleranceTables& tables;
  Timestamp received_at;
  std::optional<std::string_view> caller{};  ///< of every row
  const GaugeBook* gauges = nullptr;         ///< those in use; null: none
  /// Takes rows away as soon as there are kRowsAtATime, while none was wrong.
  std::function<void(std::vector<app::Measurement>)> take{};
  /// Finds every error in its place, also with `take`.
  bool is_exact = false;
};

/// For the readers of each format, after every row: lets `take` have the rows when there are
/// enough.
void take_full(MeasurementBatch& batch, const BatchContext& context, const FieldErrors& errors);

/// The most rows one request may have.
inline constexpr std::size_t kMostRows = 100'000;
/// So many that they stay in the cache of the processor.
inline constexpr std::size_t kRowsAtATime = 256;

/// Reads and judges the rows of a body, all or none, into an empty batch. What was taken before an
/// error is not to be used; its texts live as long as the batch and the body.
/// @param body followed by http::Request::kBodyPadding readable bytes; outlives the batch.
/// @param media_type application/json (one object or an array), application/x-ndjson or text/csv.
/// @errors JsonMalformed, JsonDuplicateKey, JsonTooDeep, TextEncoding, CsvMalformed; RequestInvalid
///   with every bad field; any when the batch `wants_whole`.
Result<void> decode_measurements(std::string_view body, std::string_view media_type,
                                 const BatchContext& context, MeasurementBatch& batch);

}  // namespace fitgauge::api

#pragma once

#include "base/json/text_arena.hpp"
#include "base/length.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// Facts of a gauge in use for its measurements, from a change or calibration to the next.
struct GaugePeriod {
  Timestamp from{std::numeric_limits<std::int64_t>::min()};
  std::string budget{};  ///< its name; empty: none
  /// Uncertainty of the budget, which is in µm, rounded up to the nanometre; none if the budget is
  /// deleted.
  std::optional<Length> standard_uncertainty{};
  std::optional<std::int64_t> degrees_of_freedom{};  ///< of the budget, in millionths
  std::string calibration_due{};                     ///< a date, or a time in UTC; empty: none
  std::optional<Timestamp> due{};                    ///< as a time; a date lasts to its end in UTC
  std::optional<std::string> certificate{};
  std::optional<std::string> laboratory{};
  bool is_blocked = false;

  bool is_overdue(Timestamp at) const { return due && *due < at; }
};

struct GaugeInUse {
  /// By time: the entries of the gauge itself, each from its change on, then its calibrations. The
  /// first has no beginning.
  std::vector<GaugePeriod> periods{1};
  std::optional<Timestamp> deleted_at{};  ///< none: it is in use

  /// Returns the period of a time; null from the deletion on.
  const GaugePeriod* at(Timestamp time) const;
};

/// The gauges in use, and the deleted ones for values that arrive late, by name.
using GaugeBook = std::map<std::string, GaugeInUse, std::less<>>;

/// Reads when a calibration begins or is due: a date, which counts from its beginning or to its end
/// in UTC, or an RFC 3339 time. None for other texts.
std::optional<Timestamp> parse_from(std::string_view text);
std::optional<Timestamp> parse_due(std::string_view text);
/// Returns the text with its time in UTC; a date stays unchanged.
std::optional<std::string> due_in_utc(std::string_view text);

class FieldErrors;

/// The judged measurements of one request. Their texts are views of the body and of `texts`.
struct MeasurementBatch {
  std::vector<app::Measurement> rows{};
  bool single = false;                  ///< the body was one object, not a list
  std::shared_ptr<const void> texts{};  ///< owns texts that were copied from the body
  bool is_begun = false;                ///< BatchContext::take already received rows
  /// The fast reader passed rows before it met an error or an escaped key. The caller discards them
  /// and decodes the whole body without `take`.
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

/// Services for the decoding of a batch. All of them outlive the batch.
struct BatchContext {
  const iso286::ToleranceTables& tables;
  Timestamp received_at;
  std::optional<std::string_view> caller{};  ///< of every row
  const GaugeBook* gauges = nullptr;         ///< gauges in use; null: none
  /// Passes rows to `take` in batches of kRowsAtATime, as long as there are no errors.
  std::function<void(std::vector<app::Measurement>)> take{};
  /// Finds every error with its place, even with `take`.
  bool is_exact = false;
  std::stop_token stop{};  ///< ends the reading after a row: ShuttingDown
};

/// Called by every format reader after each row. Passes a full batch to `take`.
void take_full(MeasurementBatch& batch, const BatchContext& context, const FieldErrors& errors);

/// The most rows one request may have.
inline constexpr std::size_t kMostRows = 100'000;
/// Few enough to stay in the cache of the processor.
inline constexpr std::size_t kRowsAtATime = 256;

/// Reads and judges the rows of a body, all or none, into an empty batch. What was taken before an
/// error is not to be used; its texts live as long as the batch and the body.
/// @param body followed by http::Request::kBodyPadding readable bytes; outlives the batch.
/// @param media_type application/json (one object or an array), application/x-ndjson or text/csv.
/// @errors JsonMalformed, JsonDuplicateKey, JsonTooDeep, TextEncoding, CsvMalformed; RequestInvalid
///   with every bad field; ShuttingDown after a stop; any when the batch `wants_whole`.
Result<void> decode_measurements(std::string_view body, std::string_view media_type,
                                 const BatchContext& context, MeasurementBatch& batch);

}  // namespace fitgauge::api

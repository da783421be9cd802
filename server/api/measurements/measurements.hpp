#pragma once

#include "api/wire/request_facts.hpp"
#include "base/json/json_writer.hpp"
#include "record/measurement_batch.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::api {

/// Parameters of a list and of a summary that select measurements.
/// @param prefix of their names, if a request has several selections: `hole_`
std::vector<Parameter> measurement_filter_parameters(std::string_view prefix = {});

/// Reads the query of a request to a route with these parameters.
/// @errors QueryInvalid; DesignationMalformed and other errors of designations.
Result<app::MeasurementQuery> measurement_query(const Services& services, const Request& request,
                                                std::string_view prefix = {});

/// GET /v1/measurements: a page with its cursor, or, as CSV or NDJSON without `limit`, all that
/// match as a stream in constant memory; DFQ and XLSX are files made whole.
void list_measurements(const Services& services, const Request& request, Responder responder);

inline constexpr std::string_view kDfqType = "application/octet-stream";
inline constexpr std::string_view kQifType = "application/xml";
inline constexpr std::string_view kXlsxType =
    "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

/// Parameters of a file in addition to those of a list.
std::vector<Parameter> download_parameters();

/// Answers with a file of the measurements that match, whole or, with a `limit`, a page of them.
/// @param media_type kDfqType, kQifType or kXlsxType. @param after the cursor.
void send_file(const Services& services, const Request& request, Responder responder,
               std::string_view media_type, app::MeasurementQuery query, std::int64_t after,
               std::optional<std::int64_t> limit);

/// The header line of the CSV form, and one line of it.
std::string measurement_csv_header();
void append_measurement_csv(std::string& out, const app::Measurement& measurement);

/// Writes `"verdicts":{…}`, with `unjudged` if there are any.
void write_verdict_counts(JsonWriter& json, const app::VerdictTally& verdicts);

/// `{"groups":[…]}`, each named by the field it is grouped by.
std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups);

/// Responds to a repeat of an idempotent request from the store; otherwise continues with
/// `first_time`, on this thread or on a reader's.
void post_once(const Services& services, const Request& request, Responder responder,
               std::function<void(const SharedPosting&)> first_time);

/// Records a batch and answers when it is durable.
void record(const SharedPosting& posting, MeasurementBatch batch);

/// POST /v1/measurements: reads the body, judges its rows and records them.
void post_measurements(const Services& services, const Request& request, Responder responder);

/// Returns warnings for a value that is stored anyway: an empty acceptance zone; an uncertainty
/// above a tenth of the tolerance with the simple rule, which ignores it; a gauge that is blocked,
/// overdue for calibration, or not registered although others are.
std::vector<Warning> warnings_of(const app::Measurement& measurement);

/// The 201 for stored measurements, in the form that the client prefers: one record, all records,
/// only their number with the counts of verdicts, or nothing.
class MeasurementAnswer final : public app::Rendering {
 public:
  explicit MeasurementAnswer(Preference wanted) : wanted_(wanted) {}

  /// Before add(): whether the body was one object, not a list.
  void set_single(bool single) { single_ = single; }
  /// Reserves memory for a response of this number of bytes.
  void expect(std::size_t body_size);

  void add(std::span<const app::Measurement> measurements, std::string_view records) override;
  app::Answer finish() override;

 private:
  void end_with_warnings();
  void warn_of(const app::Measurement& measurement);
  bool lists_records() const { return !single_ && wanted_ == Preference::Representation; }

  const Preference wanted_;
  bool single_ = false;
  app::Answer answer_{
      .status = 201, .content_type = "application/json", .location = {}, .body = {}};
  std::string first_id_;
  std::string last_id_;
  std::int64_t count_ = 0;
  app::VerdictTally verdicts_{};
  std::vector<Warning> warnings_;
  std::size_t unlisted_warnings_ = 0;
};

/// POST /v1/measurements/{id}/corrections: stores a measurement that replaces another one, with a
/// reason. Missing fields are copied, limits as they were applied.
void post_correction(const Services& services, const Request& request, Responder responder);

}  // namespace fitgauge::api

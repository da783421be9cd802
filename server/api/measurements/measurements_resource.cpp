#include "api/resources.hpp"

#include "api/measurements/measurements.hpp"
#include "api/wire/formulas.hpp"
#include "base/csv.hpp"
#include "record/record.hpp"
#include "record/record_members.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLargestRows = std::size_t{32} << 20;

/// Cells of one line of CSV.
class CsvLine {
 public:
  explicit CsvLine(std::string& out) : out_(out) {}

  void begin_cell() {
    if (!std::exchange(is_first_, false)) out_ += ',';
  }

  void word(std::string_view text) { sheet::append_csv_cell(out_, text); }
  void name(std::string_view text) { sheet::append_csv_cell(out_, text); }
  void text(std::string_view text) { sheet::append_csv_text(out_, text); }
  void time(Timestamp time) { out_ += format_rfc3339(time); }
  void mm(Length length) { append_mm(out_, length); }
  void um(Length length) { append_um(out_, length); }
  void decimal(std::int64_t value, int scale) { append_decimal(out_, value, scale); }
  void billionths(std::int64_t value) { append_decimal(out_, value, 9); }
  void truth() { out_ += "true"; }
  void null() {}

 private:
  std::string& out_;
  bool is_first_ = true;
};

void find_measurement(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, services.measurements.parse_id(*request.text("id")));
  auto body = std::make_shared<std::string>();
  services.measurements.find(
      id, [body](const app::Measurement& measurement) { app::append_record(*body, measurement); },
      answer_with(std::move(responder),
                  [body](std::int64_t) { return json_response(std::move(*body)); }));
}

void summarise(const Services& services, const Request& request, Responder responder) {
  const auto query = TRY_OR_FAIL(responder, measurement_query(services, request));
  const std::string_view group_by = request.text("group_by").value_or("characteristic");
  services.measurements.summary(query, group_by,
                                answer_with(std::move(responder), [group_by](const auto& groups) {
                                  return json_response(summary_json(group_by, groups));
                                }));
}

std::vector<Parameter> posting_parameters(std::vector<Parameter> parameters = {}) {
  parameters.push_back(idempotency_parameter());
  parameters.push_back(
      {.name = "Prefer",
       .place = http::ParameterPlace::Header,
       .type = http::Text{.schema = R"({"type":"string","enum":)"
                                    R"(["return=representation","return=minimal"]})"},
       .description = "The records, or no body"});
  return parameters;
}

std::vector<Parameter> list_parameters() {
  const std::vector<Parameter> of_list = {
      query("limit", http::Integer{.min = 1, .max = 1000},
            "Maximum number of rows of a page (default: 100)"),
      query("after", "The cursor `next` of the page before"),
      query("sort", http::Words{{"oldest", "newest"}},
            "Order by the time of storing (default: oldest first)"),
      query("notes", http::Words{{"shown", "only"}},
            "shown adds `notes` to the records in JSON and NDJSON; only "
            "lists only records with notes"),
      query("last", http::Integer{.min = 1, .max = 1000},
            "Only this number of the newest; not with `limit` or `after`"),
      format_of({"json", "csv", "ndjson", "dfq", "qif", "xlsx"}),
  };
  return measurement_filter_parameters() + of_list + download_parameters();
}

std::vector<Parameter> summary_parameters() {
  auto parameters = measurement_filter_parameters();
  const auto& fields = app::kTextFilters;
  parameters.push_back(query("group_by", http::Words{{fields.begin(), fields.end()}},
                             "Field whose values form the groups"));
  return parameters;
}

}  // namespace

std::string measurement_csv_header() {
  std::string out;
  app::for_each_column([&out](const auto& column, std::size_t /*index*/) {
    if (!out.empty()) out += ',';
    out += column.name;
  });
  return out += "\r\n";
}

void append_measurement_csv(std::string& out, const app::Measurement& measurement) {
  CsvLine line(out);
  app::for_each_column([&](const auto& column, std::size_t /*index*/) {
    line.begin_cell();
    column.write(measurement, app::MemberValue{line});
  });
  out += "\r\n";
}

void write_verdict_counts(JsonWriter& json, const app::VerdictTally& verdicts) {
  json.key("verdicts").begin_object();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const auto verdict = static_cast<gauging::Verdict>(i);
    if (verdict == gauging::Verdict::Unjudged && verdicts[i] == 0) continue;
    json.member(word(verdict), verdicts[i]);
  }
  json.end_object();
}

std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups) {
  return json_object([&](JsonWriter& json) {
    write_formula(json, "stored_summary");
    json.list("groups", groups, [&](const app::MeasurementGroup& group) {
      json.begin_object().member(group_by, group.value).member("count", group.count);
      write_verdict_counts(json, group.verdicts);
      json.key("mean_mm").raw(group.mean_mm);
      json.key("standard_deviation_mm").raw(group.standard_deviation_mm.value_or("null"));
      json.member_mm("min_mm", Length::nanometres(group.min_nm));
      json.member_mm("max_mm", Length::nanometres(group.max_nm)).end_object();
    });
  });
}

void add_measurements_routes(Routes& add) {
  add("POST /v1/measurements postMeasurements operator 404 409", post_measurements,
      {.summary = "Judge and store measurements, all or none",
       .description = "201 means durable. An Idempotency-Key makes repeats safe.",
       .parameters = posting_parameters(),
       .body = {.use = http::BodyUse::Required,
                .media_types = {"application/json", "application/x-ndjson", "text/csv"},
                .limit = kLargestRows,
                .schema = "NewMeasurements"},
       .outcomes = {{.status = 201,
                     .meaning = "Stored for good: the record of one, a count of several, or all "
                                "records with return=representation; no body with return=minimal",
                     .schema = "Recorded"}}});
  add("POST /v1/measurements/{id}/corrections correctMeasurement operator 404 409", post_correction,
      {.summary = "Correct a measurement by a new one that names it",
       .description = "The body has measured_mm and reason; fields it leaves out are taken over. "
                      "The old record stays.",
       .parameters = posting_parameters({path_parameter("id", "The measurement to correct")}),
       .body = json_body("Correction"),
       .outcomes = {{.status = 201, .meaning = "The new record", .schema = "Recorded"}}});
  add("GET /v1/measurements listMeasurements viewer", list_measurements,
      {.summary = "List measurements in storage order",
       .description = "All pages show the state at the first one. CSV and NDJSON without `limit` "
                      "stream all that match. DFQ, QIF and XLSX are files of up to 100,000, "
                      "whose records have at most 64 MiB.",
       .parameters = list_parameters(),
       .response_types = {"application/json", "application/x-ndjson", "text/csv",
                          std::string(kDfqType), std::string(kQifType), std::string(kXlsxType)},
       .outcomes = {{.meaning = "A page, or a stream of all", .schema = "MeasurementList"}}});
  add("GET /v1/measurements/summary summariseMeasurements viewer", summarise,
      {.summary = "Counts and statistics by group",
       .parameters = summary_parameters(),
       .outcomes = {{.meaning = "The groups", .schema = "Summary"}}});
  add("GET /v1/measurements/{id} getMeasurement viewer 404", find_measurement,
      {.summary = "One measurement",
       .parameters = {path_parameter("id", "Id of the record")},
       .outcomes = {{.meaning = "The record", .schema = "Measurement"}}});
}

}  // namespace fitgauge::api

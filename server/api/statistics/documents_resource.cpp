#include "api/service/document_routes.hpp"
#include "api/statistics/statistics_answers.hpp"
#include "api/wire/request_facts.hpp"
#include "service/measurements/gauges_in_use.hpp"

namespace fitgauge::api {
namespace {

Result<CheckedDocument> check_budget(const Services&, const std::string&, std::string_view text) {
  const auto body = TRY(parse_json(text));
  auto computed = TRY(compute_uncertainty(body));
  return CheckedDocument{.text = std::string(text), .answer = std::move(computed)};
}

/// The stored document judges measurements from its response on.
void reload_gauges(const Services& services, std::function<void(Result<void>)> done) {
  services.gauges.reload(std::move(done));
}

/// The form of the time from which or to which a calibration holds, in UTC.
struct Due {
  std::string schema(Side) const { return schema::text(); }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const {
    const auto given = fields.text(name);
    if (!given) return false;
    auto due = due_in_utc(*given);
    if (due) {
      to = *std::move(due);
    } else {
      fields.report(ErrorCode::TimeMalformed, name,
                    "{} must be a date such as 2027-03-31, or an RFC 3339 time", name);
    }
    return due.has_value();
  }
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};

struct GaugeOrder {
  std::optional<std::string> uncertainty{};
  std::string calibration_due{};
  std::optional<std::string> comment{};
};
void gauge_members(auto& v, auto& gauge) {
  v.optional("uncertainty", gauge.uncertainty, "The name of its budget, in µm");
  v.member("calibration_due", gauge.calibration_due, Due{},
           "A date, to its end in UTC, or an RFC 3339 time");
  v.optional("comment", gauge.comment, Text{.longest = 2000});
}
void members(auto& v, GaugeOrder& gauge) { gauge_members(v, gauge); }
void members(auto& v, const GaugeOrder& gauge) { gauge_members(v, gauge); }

Result<CheckedDocument> check_gauge(const Services&, const std::string&, std::string_view text) {
  const auto body = TRY(parse_json(text));
  auto gauge = TRY(read_whole<GaugeOrder>(body));
  return CheckedDocument{.text = body_json(gauge), .uncertainty = std::move(gauge.uncertainty)};
}

enum class Status : std::uint8_t { InUse, Blocked };
constexpr OneOf<2> kStatuses{"in_use", "blocked"};
constexpr Text kShort{.longest = 200};

/// A calibration of a gauge, or that it is blocked from a time on.
struct Calibration {
  std::string from{};
  std::optional<std::string> due{};
  std::optional<std::string> certificate{};
  std::optional<std::string> laboratory{};
  Status status = Status::InUse;
  std::optional<std::string> uncertainty{};
  std::optional<double> as_found{};
  std::optional<double> as_left{};
  std::optional<std::string> comment{};
  Timestamp recorded_at{};
  std::optional<std::string> caller{};
};
void given_members(auto& v, auto& c) {
  v.member("from", c.from, Due{}, "A date, from its beginning in UTC, or an RFC 3339 time");
  v.optional("due", c.due, Due{}, "A date, to its end, or a time; required unless it is blocked");
  v.optional("certificate", c.certificate, kShort, "Number of the calibration certificate");
  v.optional("laboratory", c.laboratory, kShort, "Laboratory");
  v.optional("status", c.status, kStatuses, "blocked: it must not be used from then on");
  v.optional("uncertainty", c.uncertainty, "The name of its budget, in µm; else the gauge's own");
  v.optional("as_found_um", c.as_found, Number{}, "Error that the calibration found");
  v.optional("as_left_um", c.as_left, Number{}, "Error after its adjustment");
  v.optional("comment", c.comment, Text{.longest = 2000});
}

struct CalibrationOrder {
  Calibration given{};
};
void members(auto& v, CalibrationOrder& order) {
  given_members(v, order.given);
  v.check([&](FieldReader& fields) {
    const Calibration& c = order.given;
    const auto due = c.due ? parse_due(*c.due) : std::nullopt;
    if (!due && c.status == Status::InUse) {
      fields.report(ErrorCode::FieldMissing, "due", "due is required of a gauge in use");
    } else if (const auto from = parse_from(c.from); due && from && *due < *from) {
      fields.report(ErrorCode::FieldInvalid, "due", "due must be later than from");
    }
  });
}

}  // namespace

void members(auto& v, const Calibration& calibration) {
  given_members(v, calibration);
  v.member("recorded_at", calibration.recorded_at, Time{}, "Time of storing, in UTC");
  v.optional("caller", calibration.caller, "The name of the key that stored it");
}

namespace {

void record_calibration(const Services& services, const Request& request, Responder responder) {
  const auto body = TRY_OR_FAIL(responder, parse_json(request.body()));
  auto order = TRY_OR_FAIL(responder, read_whole<CalibrationOrder>(body));
  Calibration& given = order.given;
  given.recorded_at = services.clock.now();
  given.caller = caller_text(request);
  const std::string gauge(*request.text("name"));
  const std::string text = body_json(given);
  services.documents.write(
      {.kind = app::DocumentKind::Calibration,
       .name = app::calibration_name(gauge, *parse_from(given.from)),
       .text = text,
       .caller = given.caller,
       .uncertainty = given.uncertainty,
       .gauge = gauge},
      [&services, text, shared = share(std::move(responder))](const Result<bool>& is_new) {
        if (!is_new) return shared->fail(at_budget(is_new.error()));
        services.gauges.reload(
            [shared, text, status = *is_new ? 201 : 200](const Result<void>& heard) {
              if (!heard) return shared->fail(heard.error());
              shared->answer({status, "application/json", text});
            });
      });
}

void list_calibrations(const Services& services, const Request& request, Responder responder) {
  services.documents.list_each(
      {app::DocumentKind::GaugeInUse, app::DocumentKind::Calibration}, false,
      [gauge = std::string(*request.text("name")), shared = share(std::move(responder))](
          const Result<std::vector<std::vector<app::NamedDocument>>>& lists) {
        if (!lists) return shared->fail(lists.error());
        std::multimap<std::optional<Timestamp>, std::string_view> found;
        for (const app::NamedDocument& calibration : (*lists)[1]) {
          const std::string_view name = calibration.name;
          if (app::gauge_of_calibration(name) != gauge) continue;
          found.emplace(parse_from(name.substr(gauge.size() + 1)), calibration.text);
        }
        if (found.empty() && std::none_of((*lists)[0].begin(), (*lists)[0].end(),
                                          [&](const auto& each) { return each.name == gauge; })) {
          return shared->fail(
              {ErrorCode::GaugeUnknown, fmt::format("gauge in use not found: '{}'", gauge)});
        }
        shared->answer({200, "application/json", json_object([&](JsonWriter& json) {
                          json.list("calibrations", found,
                                    [&](const auto& each) { json.raw(each.second); });
                        })});
      });
}

enum class StudyKind : std::uint8_t { OnMaster, OnParts };
constexpr OneOf<2> kStudyKinds{"type1", "grr"};

/// The form of the order and the answer of a figure, in their JSON.
struct FigureText {
  std::string_view of_master;
  std::string_view of_parts;
  static constexpr bool kHasDefault = false;

  std::string schema(Side) const {
    return schema::one_of({schema::ref(of_master), schema::ref(of_parts)});
  }
  bool read(FieldReader& fields, std::string_view name, JsonValue& to) const {
    const JsonValue* given = fields.object(name);
    if (given != nullptr) to = *given;
    return given != nullptr;
  }
  void write(JsonWriter& json, const JsonValue& from) const { write_json(json, from); }
  void write(JsonWriter& json, std::string_view from) const { json.raw(from); }
};

/// A study of a gauge; its input defines its result.
struct StudyOrder {
  std::string gauge{};
  std::string at{};
  StudyKind kind{};
  std::optional<std::string> comment{};
  JsonValue input{};
};
void study_members(auto& v, auto& study) {
  v.member("gauge", study.gauge, "The name of a gauge in use");
  v.member("at", study.at, Due{}, "When it was made: a date, or an RFC 3339 time");
  v.member("kind", study.kind, kStudyKinds, "As POST /v1/statistics/{kind}");
  v.optional("comment", study.comment, Text{.longest = 2000});
  v.member("input", study.input, FigureText{"Type1Order", "GaugeStudyOrder"},
           "The body of POST /v1/statistics/{kind}");
}
void members(auto& v, StudyOrder& order) { study_members(v, order); }

struct StudyAnswer {
  StudyOrder order{};
  std::string result{};
};
void members(auto& v, const StudyAnswer& study) {
  study_members(v, study.order);
  v.member("result", study.result, FigureText{"Type1Study", "GaugeStudy"},
           "The result that was computed when the input was stored");
}

Result<CheckedDocument> check_study(const Services&, const std::string&, std::string_view text) {
  const auto body = TRY(parse_json(text));
  auto order = TRY(read_whole<StudyOrder>(body));
  auto result =
      order.kind == StudyKind::OnMaster ? master_study(order.input) : gauge_study(order.input);
  if (!result) {
    Error error = result.error();
    for (Error& each : error.details) each.where.insert(0, "/input");
    return error;
  }
  const std::string stored = body_json(StudyAnswer{order, *std::move(result)});
  return CheckedDocument{.text = stored, .answer = stored, .gauge = std::move(order.gauge)};
}

Result<void> describe_study(JsonWriter& json, const app::NamedDocument& study) {
  const auto body = TRY(parse_stored_json(study.text, "study"));
  json.member("name", study.name);
  for (const char* name : {"gauge", "at", "kind"}) json.member(name, body.text_of(name));
  return {};
}

constexpr KindOfDocument kUncertainties{.kind = app::DocumentKind::Uncertainty,
                                        .path = "/v1/uncertainties",
                                        .one = "an uncertainty budget",
                                        .contents = "what contributes to it",
                                        .many = "uncertainty budgets",
                                        .member = "uncertainties",
                                        .operation = "Uncertainty",
                                        .operations = "Uncertainties",
                                        .schema = "UncertaintyBudget",
                                        .list_schema = "UncertaintyBudgetNames",
                                        .answered = "Uncertainty",
                                        .is_figure = true,
                                        .check = check_budget,
                                        .changed = reload_gauges};
constexpr KindOfDocument kGauges{.kind = app::DocumentKind::GaugeInUse,
                                 .path = "/v1/gauges-in-use",
                                 .one = "a gauge in use",
                                 .contents = "its uncertainty and when its calibration is due",
                                 .many = "gauges in use",
                                 .member = "gauges",
                                 .operation = "GaugeInUse",
                                 .operations = "GaugesInUse",
                                 .list_schema = "GaugeInUseNames",
                                 .check = check_gauge,
                                 .changed = reload_gauges};
constexpr KindOfDocument kStudies{.kind = app::DocumentKind::Study,
                                  .path = "/v1/studies",
                                  .one = "a study of a gauge",
                                  .contents = "its input, whose result is computed",
                                  .many = "studies of gauges",
                                  .member = "studies",
                                  .operation = "Study",
                                  .operations = "Studies",
                                  .body_schema = "StudyOrder",
                                  .answered = "Study",
                                  .describe = describe_study,
                                  .is_figure = true,
                                  .check = check_study};

}  // namespace

void add_documents_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<GaugeOrder>("GaugeInUse"));
  schemas.push_back(order_schema<CalibrationOrder>("NewCalibration"));
  schemas.push_back(answer_schema<Calibration>("Calibration"));
  schemas.push_back(
      {"Calibrations", schema::object({{"calibrations", schema::array(schema::ref("Calibration")),
                                        "Sorted by `from`"}})});
  schemas.push_back(names_schema("UncertaintyBudgetNames", "uncertainties"));
  schemas.push_back(names_schema("GaugeInUseNames", "gauges"));
  schemas.push_back(order_schema<StudyOrder>("StudyOrder"));
  schemas.push_back(answer_schema<StudyAnswer>("Study"));
  schemas.push_back(names_schema("Studies", "studies",
                                 {{"gauge", schema::text(), "Its gauge in use"},
                                  {"at", schema::text(), "When it was made"},
                                  {"kind", kStudyKinds.schema(Side::Answer), ""}}));
}

void add_documents_routes(Routes& add) {
  add_document_routes(add, kUncertainties);
  add_document_routes(add, kGauges);
  add_document_routes(add, kStudies);
  const Parameter name = path_parameter("name", "Name of the gauge in use");
  add("POST /v1/gauges-in-use/{name}/calibrations recordCalibration admin 404", record_calibration,
      {.summary = "Record a calibration of a gauge in use, or that it is blocked",
       .description = "A condition is in force from its beginning to the beginning of the next "
                      "one. A condition with the same beginning replaces it.",
       .parameters = {name},
       .body = json_body("NewCalibration"),
       .outcomes = {
           {.meaning = "Replaced a calibration with the same `from`", .schema = "Calibration"},
           {.status = 201, .meaning = "Recorded", .schema = "Calibration"}}});
  add("GET /v1/gauges-in-use/{name}/calibrations listCalibrations viewer 404", list_calibrations,
      {.summary = "The calibrations of a gauge in use",
       .parameters = {name},
       .outcomes = {{.meaning = "Sorted by `from`", .schema = "Calibrations"}}});
}

}  // namespace fitgauge::api

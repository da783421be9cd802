#include "api/measurements/measurements.hpp"

#include "record/measurement_row_reader.hpp"
#include "record/note.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/tables/table_catalog.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLongestReason = 2000;
constexpr std::array<std::string_view, 7> kLimitsFields = {
    "designation", "nominal_mm", "tolerance_class", "quantity", "feature", "upper_um", "lower_um"};

constexpr std::array<std::string_view, 2> kGaugeFields = {"gauge", "measured_at"};
/// A field of the original, and the field that replaces it if the correction gives that.
struct Replaced {
  std::string_view field;
  std::string_view by;
};
constexpr std::array<Replaced, 10> kReplaced = {{
    {"confirmed", "measured_mm"},  // another value is confirmed anew
    {"degrees_of_freedom", "uncertainty_um"},
    {"part_expansion_um_per_m_k", "part_material"},
    {"part_material", "part_expansion_um_per_m_k"},
    {"scale_expansion_um_per_m_k", "scale_material"},
    {"scale_material", "scale_expansion_um_per_m_k"},
    // Another coefficient has another uncertainty.
    {"part_expansion_uncertainty_um_per_m_k", "part_material"},
    {"part_expansion_uncertainty_um_per_m_k", "part_expansion_um_per_m_k"},
    {"scale_expansion_uncertainty_um_per_m_k", "scale_material"},
    {"scale_expansion_uncertainty_um_per_m_k", "scale_expansion_um_per_m_k"},
}};

/// The owner of the texts of the correction.
struct Sources {
  JsonValue body;
  app::KeptMeasurement original;
  std::shared_ptr<const iso286::ToleranceTables> tables;
  std::shared_ptr<const GaugeBook> gauges;
};

/// Gives the row a field of the original, unless the row already has it.
void offer(MeasurementRowReader& reader, std::string_view name,
           const std::optional<std::string_view>& text) {
  if (text) reader.field(name, {.kind = RawValue::Kind::String, .text = *text});
}

bool names_any(const JsonValue& body, std::span<const std::string_view> fields) {
  return std::ranges::any_of(fields,
                             [&](std::string_view field) { return body.find(field) != nullptr; });
}

/// The correction states that the value is not a hole or shaft.
bool is_without_feature(const JsonValue& body) {
  const JsonValue* quantity = body.find("quantity");
  const auto said =
      quantity == nullptr ? std::nullopt : gauging::quantity_from_word(quantity->text);
  return said && !gauging::has_feature(*said);
}

/// A correction without limits keeps the applied ones; with some limits it copies the others.
void take_over_limits(MeasurementRowReader& reader, const JsonValue& body,
                      const app::Measurement& original) {
  if (!names_any(body, kLimitsFields)) return reader.take_limits(original);
  // No class makes a width: somebody gave it.
  if (original.quantity == gauging::Quantity::Width)
    offer(reader, "quantity", word(*original.quantity));
  if (body.find("designation") != nullptr) return;
  if (original.has_nominal()) offer(reader, "nominal_mm", format_mm(original.nominal_size));
  if (!original.class_name && original.quantity)
    offer(reader, "quantity", word(*original.quantity));
  if (body.find("tolerance_class") != nullptr) return;
  const bool by_drawing = names_any(body, std::span(kLimitsFields).last(3));
  if (!by_drawing && original.class_name) {
    if (standards::is_class(*original.class_name) && original.has_feature())
      offer(reader, "feature", word(original.feature));
    return offer(reader, "tolerance_class", original.class_name);
  }
  if (original.has_feature() && original.is_judged() && !is_without_feature(body))
    offer(reader, "feature", word(original.feature));
  if (original.has_upper_limit()) offer(reader, "upper_um", format_um(original.deviations.upper));
  if (original.has_lower_limit()) offer(reader, "lower_um", format_um(original.deviations.lower));
}

/// The service computed the factor, so it computes it again from the facts of the correction.
bool is_default_coverage(const app::Measurement& original) {
  return original.rule.kind() == gauging::DecisionRule::Kind::GuardBand &&
         original.coverage_factor == default_coverage(known_uncertainty(original));
}

/// The service gave the field its value, and does so again.
bool is_derived(const app::MeasurementField& field, const app::Measurement& original) {
  // A budget gives its degrees of freedom together with its uncertainty.
  if (field.number == &app::MeasurementFields::degrees_of_freedom)
    return original.uncertainty_budget.has_value();
  return field.text == &app::MeasurementFields::size_operator &&
         original.size_operator == app::kTwoPoint;
}

/// The corrected value cannot have the field: it is no size, or its designation requires no
/// envelope.
bool is_out_of_place(const app::MeasurementField& field, const JsonValue& body) {
  const bool is_of_envelope = field.text == &app::MeasurementFields::envelope ||
                              field.text == &app::MeasurementFields::go_gauge;
  const bool is_of_size = is_of_envelope || field.text == &app::MeasurementFields::size_operator;
  if (is_of_size && is_without_feature(body)) return true;
  const JsonValue* designation = body.find("designation");
  if (!is_of_envelope || designation == nullptr || body.find("envelope") != nullptr) return false;
  const auto size = iso286::parse_designation(designation->text);
  return !size || !size->has_envelope;
}

void take_over(MeasurementRowReader& reader, const JsonValue& body,
               const app::Measurement& original) {
  take_over_limits(reader, body, original);
  for (const app::MeasurementField& field : app::kGivenFields) {
    const bool is_replaced = std::ranges::any_of(kReplaced, [&](const Replaced& pair) {
      return pair.field == field.name && body.find(pair.by) != nullptr;
    });
    if (is_replaced || is_derived(field, original) || is_out_of_place(field, body)) continue;
    if (field.text != nullptr) {
      offer(reader, field.name, original.*field.text);
    } else if (const auto& number = original.*field.number) {
      offer(reader, field.name, app::number_text(field, *number));
    }
  }
  offer(reader, "measured_at", format_rfc3339(original.measured_at));
  if (original.is_judged()) offer(reader, "rule", word(original.rule.kind()));
  // The gauge's data is unchanged, unless another gauge or time is given.
  if (!names_any(body, kGaugeFields)) reader.take_gauge(original);
  if (original.standard_uncertainty && !original.uncertainty_budget)
    offer(reader, "uncertainty_um", format_um(*original.standard_uncertainty));
  const JsonValue* rule = body.find("rule");
  const std::string_view decides = rule == nullptr ? word(original.rule.kind()) : rule->text;
  if (original.coverage_factor && !is_default_coverage(original) &&
      decides != word(gauging::DecisionRule::Kind::Conformance))
    offer(reader, "coverage_factor", format(*original.coverage_factor));
  const bool conforms = decides == word(original.rule.kind());
  if (original.conformance && conforms)
    offer(reader, "probability", format(original.rule.probability()));
}

std::optional<std::string_view> read_reason(const JsonValue& body, FieldErrors& errors) {
  const auto wrong = [&errors](ErrorCode code, std::string message) {
    errors.add(code, "/reason", std::move(message));
    return std::nullopt;
  };
  const JsonValue* reason = body.find("reason");
  if (reason == nullptr) return wrong(ErrorCode::FieldMissing, "reason is required");
  if (!reason->is(JsonValue::Kind::String)) {
    return wrong(ErrorCode::FieldType,
                 fmt::format("reason must be a string; got {}", name_of(reason->kind)));
  }
  NoteText{kLongestReason}.check(errors, "/reason", "reason", reason->text);
  return reason->text;
}

Result<MeasurementBatch> decode(const std::shared_ptr<const Sources>& sources,
                                Timestamp received_at, std::optional<std::string_view> caller,
                                std::string_view own_origin) {
  FieldErrors errors;
  const JsonValue& body = sources->body;
  if (!body.is(JsonValue::Kind::Object)) {
    errors.add(ErrorCode::FieldType, "",
               fmt::format("a correction must be an object; got {}", name_of(body.kind)));
    return *errors.take();
  }
  const auto reason = read_reason(body, errors);
  const BatchContext context{.tables = *sources->tables,
                             .received_at = received_at,
                             .caller = caller,
                             .gauges = sources->gauges.get()};
  MeasurementRowReader reader(context, errors);
  reader.begin(std::nullopt);
  for (const auto& [name, value] : body.members) {
    if (name != "reason" && !reader.field(name, raw_value(value))) reader.report_unknown(name);
  }
  take_over(reader, body, *sources->original);
  const app::Measurement* row = reader.end();
  if (auto error = errors.take()) return *std::move(error);
  MeasurementBatch batch{.rows = {*row}, .single = true, .texts = sources};
  const app::Measurement& original = *sources->original;
  batch.rows.front().correction_of = original.id;
  if (original.origin != own_origin) {
    batch.rows.front().corrected_elsewhere = {
        .row = original.row, .origin = original.origin_number, .digits = original.origin};
  }
  batch.rows.front().correction_reason = reason;
  return batch;
}

void correct(const SharedPosting& posting, const app::Measurement& original) {
  if (original.source == app::Source::Simulation) {
    return posting->responder.fail({ErrorCode::MeasurementSimulated,
                                    "a simulated measurement cannot be corrected: correct its "
                                    "program or setup, and run it again"});
  }
  const auto tables = TRY_OR_FAIL(posting->responder, posting->services.tables.tables());
  auto body = TRY_OR_FAIL(posting->responder, parse_json(posting->request.body()));
  auto batch = TRY_OR_FAIL(posting->responder,
                           decode(std::shared_ptr<const Sources>(
                                      new Sources{std::move(body), app::KeptMeasurement(original),
                                                  tables, posting->services.gauges.book()}),
                                  posting->services.clock.now(), caller_name(posting->request),
                                  posting->services.log.origin()));
  record(posting, std::move(batch));
}

void find_and_correct(const SharedPosting& posting, const app::RecordName& id) {
  const auto original = std::make_shared<std::optional<app::KeptMeasurement>>();
  posting->services.measurements.find(
      id, [original](const app::Measurement& found) { original->emplace(found); },
      [posting, original](const Result<std::int64_t>& found) {
        if (!found) return posting->responder.fail(found.error());
        correct(posting, ***original);
      });
}

}  // namespace

void post_correction(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, services.measurements.parse_id(*request.text("id")));
  post_once(services, request, std::move(responder),
            [id](const SharedPosting& posting) { find_and_correct(posting, id); });
}

}  // namespace fitgauge::api

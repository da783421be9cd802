#include "record/measurement.hpp"

namespace fitgauge::app {
namespace {

constexpr char kMeasurementPrefix = 'm';
constexpr char kRunPrefix = 'r';
constexpr char kNotePrefix = 'n';

std::string id_text(char prefix, std::int64_t id, std::string_view origin) {
  const fmt::format_int digits(id);  // each record has one: a format string to read costs more
  std::string text;
  text.reserve(2 + digits.size() + origin.size());
  text += prefix;
  text.append(digits.data(), digits.size());
  text += '-';
  return text += origin;
}

std::optional<std::int64_t> parse_number(char prefix, std::string_view text) {
  if (text.size() < 2 || text.front() != prefix || text[1] == '0') return std::nullopt;
  const auto id = read_number<std::int64_t>(text.substr(1));
  return id && *id > 0 ? id : std::nullopt;
}

std::optional<RecordName> parse_id(char prefix, std::string_view text, const Origins& origins) {
  const std::size_t dash = std::min(text.find('-', 2), text.size());
  const auto number = parse_number(prefix, text.substr(0, dash));
  if (!number || dash + 1 == text.size()) return std::nullopt;
  const Counted what = prefix == kRunPrefix    ? Counted::Run
                       : prefix == kNotePrefix ? Counted::Note
                                               : Counted::Measurement;
  const auto origin = origins.number(text.substr(std::min(dash + 1, text.size())), *number, what);
  if (!origin) return std::nullopt;
  return RecordName{.origin = *origin, .number = *number};
}

Error unknown_run(std::string_view text) {
  return {ErrorCode::RunUnknown,
          "run not found: '" + std::string(first_characters(text, 40)) + "'"};
}

}  // namespace

bool sets_aside(std::span<const Note> notes) {
  const auto last = std::find_if(notes.rbegin(), notes.rend(), [](const Note& note) {
    return note.measure == kSetAside || note.measure == kCountedAgain;
  });
  return last != notes.rend() && last->measure == kSetAside;
}

KeptMeasurement::KeptMeasurement(const Measurement& measurement) : measurement_(measurement) {
  measurement_.notes = {};
  const auto keep = [this](std::optional<std::string_view>& text) {
    if (text) text = texts_.emplace_back(*text);
  };
  for (const MeasurementField& field : kMeasurementFields) {
    if (field.text != nullptr) keep(measurement_.*field.text);
  }
  keep(measurement_.class_name);
}

std::string number_text(const MeasurementField& field, std::int64_t number) {
  return field.accepted.is_truth ? "true" : format_decimal(number, field.scale);
}

void apply_limits(Measurement& measurement, const iso286::LimitsOfSize& limits,
                  const iso286::ToleranceTables& tables) {
  if (!measurement.quantity) measurement.quantity = gauging::Quantity::Diameter;
  measurement.nominal_size = limits.nominal_size.length();
  measurement.class_name = tables.class_name(limits.class_id);
  measurement.feature = limits.feature;
  measurement.deviations = limits.deviations;
  measurement.size_range = limits.size_range;
  measurement.basis =
      limits.basis == iso286::Basis::Custom ? LimitsBasis::Custom : LimitsBasis::Iso286;
  measurement.table_revision = tables.revision().id;
}

gauging::Quantity quantity_of(const standards::DesignatedLimits& limits) {
  if (!limits.feature_is_open) return gauging::Quantity::PitchDiameter;
  switch (limits.tolerance_class.front()) {
    case 'R': return gauging::Quantity::Radius;
    case 'C': return gauging::Quantity::Chamfer;
    default: return gauging::Quantity::Distance;
  }
}

void apply_limits(Measurement& measurement, const standards::DesignatedLimits& limits) {
  if (!measurement.quantity) measurement.quantity = quantity_of(limits);
  measurement.nominal_size = limits.nominal;
  measurement.class_name = limits.tolerance_class;
  measurement.feature = limits.feature;
  measurement.deviations = limits.deviations;
  measurement.size_range = limits.size_range;
  measurement.basis = LimitsBasis::Standard;
  measurement.table_revision = limits.standard->revision;
}

void apply_limits(Measurement& measurement, const Measurement& other) {
  if (!measurement.quantity) measurement.quantity = other.quantity;
  measurement.nominal_size = other.nominal_size;
  measurement.class_name = other.class_name;
  measurement.feature = other.feature;
  measurement.deviations = other.deviations;
  measurement.size_range = other.size_range;
  measurement.basis = other.basis;
  measurement.table_revision = other.table_revision;
  measurement.revision_number = other.revision_number;
}

void apply_no_limits(Measurement& measurement, std::optional<Length> nominal) {
  measurement.basis = nominal ? LimitsBasis::None : LimitsBasis::Bare;
  measurement.nominal_size = nominal.value_or(Length());
  measurement.deviations = {.upper = kNoLimit, .lower = -kNoLimit};
}

void judge(Measurement& measurement) {
  if (!measurement.is_judged()) {
    measurement.result = {.verdict = gauging::Verdict::Unjudged, .excess = {}};
    return;
  }
  const gauging::Beyond beyond = measurement.quantity
                                     ? gauging::Beyond(*measurement.quantity, measurement.feature,
                                                       measurement.inside_corner.has_value())
                                     : gauging::Beyond(measurement.feature);
  measurement.result = gauging::gauge(beyond, measurement.upper_limit(), measurement.lower_limit(),
                                      measurement.decisive(), measurement.rule);
  // Too much material: a hole can be widened, a shaft turned down.
  if (measurement.has_failed_envelope() && measurement.result.verdict != gauging::Verdict::Reject) {
    measurement.result.verdict = gauging::Verdict::Rework;
  }
  if (measurement.rule.kind() != gauging::DecisionRule::Kind::Conformance) return;
  measurement.conformance = gauging::conformance_figures(
      {.upper = measurement.upper_limit(), .lower = measurement.lower_limit()},
      measurement.decisive(), measurement.rule.uncertainty(),
      measurement.rule.probability().value());
}

void judge_size(Measurement& measurement, const CycleSize& size) {
  measurement.quantity = size.quantity;
  measurement.feature = size.feature;
  measurement.measured = size.measured;
  if (size.limits) {
    measurement.basis = LimitsBasis::Explicit;
    measurement.nominal_size = size.nominal.value();
    measurement.deviations = {.upper = size.limits->upper - measurement.nominal_size,
                              .lower = size.limits->lower - measurement.nominal_size};
  } else {
    apply_no_limits(measurement, size.nominal);
  }
  judge(measurement);
}

std::string measurement_id_text(std::int64_t id, std::string_view origin) {
  return id_text(kMeasurementPrefix, id, origin);
}

std::string run_id_text(std::int64_t id, std::string_view origin) {
  return id_text(kRunPrefix, id, origin);
}

std::string note_id_text(std::int64_t id, std::string_view origin) {
  return id_text(kNotePrefix, id, origin);
}

std::optional<RecordName> parse_note_id(std::string_view text, const Origins& origins) {
  return parse_id(kNotePrefix, text, origins);
}

std::string corrected_id_text(const Measurement& m) {
  return measurement_id_text(*m.correction_of,
                             m.corrected_elsewhere ? m.corrected_elsewhere->digits : m.origin);
}

std::string corrector_id_text(const Measurement& m) {
  if (!m.corrected_by) return {};
  return measurement_id_text(*m.corrected_by,
                             m.corrected_by_origin.empty() ? m.origin : m.corrected_by_origin);
}

Result<RecordName> parse_measurement_id(std::string_view text, const Origins& origins) {
  if (const auto name = parse_id(kMeasurementPrefix, text, origins)) return *name;
  return Error{ErrorCode::MeasurementUnknown,
               "measurement not found: '" + std::string(first_characters(text, 40)) + "'"};
}

Result<std::int64_t> parse_own_run_id(std::string_view text, const Origins& origins) {
  const auto name = parse_id(kRunPrefix, text, origins);
  if (!name || name->origin != 0) return unknown_run(text);
  return name->number;
}

Result<RecordName> parse_run_id(std::string_view text, const Origins& origins) {
  if (const auto name = parse_id(kRunPrefix, text, origins)) return *name;
  return unknown_run(text);
}

}  // namespace fitgauge::app

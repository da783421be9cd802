#include "record/measurement_row_reader.hpp"

namespace fitgauge::api {
namespace {

constexpr std::int64_t kMillion = 1'000'000;
constexpr std::int64_t kLargestCoverage = 100 * kMillion;

std::size_t search_field(std::string_view name) {
  const auto found =
      std::ranges::find_if(kRowFields, [&](const RowField& field) { return field.name == name; });
  return static_cast<std::size_t>(found - kRowFields.begin());
}

}  // namespace

RawValue raw_value(const JsonValue& value) {
  const bool is_truth = value.is(JsonValue::Kind::Boolean);
  return {.kind = value.kind,
          .text = is_truth ? (value.boolean ? "true" : "false") : std::string_view(value.text)};
}

bool MeasurementRowReader::knows(std::string_view name) {
  return search_field(name) < RowField::Count;
}

// Rows of a request, and mostly of the next one, have their fields in one order: the n-th field is
// usually the previous n-th.
std::size_t MeasurementRowReader::find_field(std::string_view name) {
  static thread_local std::array<std::uint8_t, 32> order{};
  std::uint8_t& expected = order[position_++ % order.size()];
  if (kRowFields[expected].name == name) return expected;
  const std::size_t field = search_field(name);
  if (field < RowField::Count) expected = static_cast<std::uint8_t>(field);
  return field;
}

void MeasurementRowReader::begin(std::optional<std::size_t> row, std::optional<std::size_t> line) {
  row_ = row;
  line_ = line;
  position_ = 0;
  draft_ = {};
}

void MeasurementRowReader::report(ErrorCode code, std::optional<std::string_view> field,
                                  std::string message) {
  draft_.failed = true;
  std::string pointer = row_ ? pointer_to("", *row_) : std::string();
  if (field) pointer = pointer_to(pointer, *field);
  errors_.add(code, std::move(pointer), std::move(message), line_);
}

void MeasurementRowReader::report(std::size_t field, const Error& error) {
  report(error.code, kRowFields[field].name, error.message);
}

void MeasurementRowReader::report_unknown(std::string_view name) {
  report(ErrorCode::FieldUnknown, name, fmt::format("unknown field {}", name));
}

void MeasurementRowReader::report_row(ErrorCode code, std::string message) {
  report(code, std::nullopt, std::move(message));
}

bool MeasurementRowReader::field(std::string_view name, const RawValue& value) {
  const std::size_t field = find_field(name);
  if (field == RowField::Count || given(field)) return false;
  static_assert(RowField::Count <= 8 * sizeof(draft_.given));
  draft_.given |= std::uint64_t{1} << field;
  assign(field, value);
  return true;
}

void MeasurementRowReader::assign(std::size_t field, const RawValue& value) {
  app::Measurement& m = draft_.measurement;
  switch (field) {
    case RowField::Measured: draft_.measured = length(field, value, false, true); break;
    case RowField::Nominal: draft_.nominal = length(field, value, false); break;
    case RowField::Class: draft_.class_name = text(field, value); break;
    case RowField::Designation: draft_.designation = text(field, value); break;
    case RowField::Feature:
      if (const auto given_word = text(field, value)) {
        draft_.feature = iso286::feature_from_word(*given_word);
        if (!draft_.feature)
          report(field, {ErrorCode::FieldInvalid, "feature must be one of: hole, shaft"});
      }
      break;
    case RowField::Quantity:
      if (const auto given_word = text(field, value)) {
        draft_.quantity = gauging::quantity_from_word(*given_word);
        if (!draft_.quantity) {
          report(field,
                 {ErrorCode::FieldInvalid, fmt::format("quantity must be one of: {}",
                                                       fmt::join(gauging::kQuantityWords, ", "))});
        }
      }
      break;
    case RowField::Upper: draft_.upper = length(field, value, true); break;
    case RowField::Lower: draft_.lower = length(field, value, true); break;
    case RowField::MeasuredAt:
      if (const auto time = text(field, value)) {
        const auto parsed = parse_rfc3339(*time);
        parsed ? void(m.measured_at = *parsed) : report(field, parsed.error());
      }
      break;
    case RowField::Uncertainty:
      m.standard_uncertainty = length(field, value, true);
      if (!m.standard_uncertainty) break;
      if (const auto checked = check_uncertainty(*m.standard_uncertainty); !checked) {
        report(field, checked.error());
      }
      break;
    case RowField::Coverage:
      draft_.rule.coverage_millionths =
          decimal_in(field, value, 1, kLargestCoverage, "must be above 0 and at most 100");
      break;
    case RowField::Rule:
      if (const auto rule = text(field, value)) {
        const auto kind = gauging::rule_from_word(*rule);
        draft_.rule.kind = kind.value_or(draft_.rule.kind);
        if (!kind) {
          report(field,
                 {ErrorCode::FieldInvalid, "rule must be one of: simple, guard_band, conformance"});
        }
      }
      break;
    case RowField::Probability:
      draft_.rule.probability_millionths =
          decimal_in(field, value, kMillion / 2, kMillion - 1, "must be at least 0.5 and below 1");
      break;
    default: {
      const app::MeasurementField& plain = *kRowFields[field].plain;
      if (plain.text != nullptr) {
        m.*plain.text = text(field, value);
      } else if (plain.accepted.is_truth) {
        m.*plain.number = truth(field, value);
      } else {
        m.*plain.number = decimal_in(field, value, plain.accepted.least, plain.accepted.most,
                                     plain.accepted.range);
      }
    }
  }
}

bool MeasurementRowReader::check_number(std::size_t field, const RawValue& value) {
  const bool fits = value.kind == RawValue::Kind::Number || value.kind == RawValue::Kind::String;
  if (!fits) {
    report(field, {ErrorCode::FieldType, fmt::format("{} must be a number; got {}",
                                                     kRowFields[field].name, name_of(value.kind))});
  }
  return fits;
}

std::optional<Length> MeasurementRowReader::length(std::size_t field, const RawValue& value,
                                                   bool micrometres, bool round) {
  if (!check_number(field, value)) return std::nullopt;
  const DecimalSyntax syntax{.decimal_comma = value.decimal_comma,
                             .exponent = value.kind == RawValue::Kind::Number,
                             .round_to_nearest = round};
  const auto parsed =
      micrometres ? parse_length_um(value.text, syntax) : parse_length_mm(value.text, syntax);
  if (parsed) return *parsed;
  report(field, parsed.error());
  return std::nullopt;
}

std::optional<std::int64_t> MeasurementRowReader::decimal(std::size_t field,
                                                          const RawValue& value) {
  if (!check_number(field, value)) return std::nullopt;
  const app::MeasurementField* const plain = kRowFields[field].plain;
  const auto parsed = parse_decimal(value.text, {.scale = plain == nullptr ? 6 : plain->scale,
                                                 .decimal_comma = value.decimal_comma,
                                                 .exponent = value.kind == RawValue::Kind::Number});
  if (parsed) return *parsed;
  const bool too_fine = parsed.error().code == ErrorCode::LengthTooFine;
  report(too_fine ? ErrorCode::FieldInvalid : parsed.error().code, kRowFields[field].name,
         parsed.error().message);
  return std::nullopt;
}

std::optional<std::int64_t> MeasurementRowReader::decimal_in(std::size_t field,
                                                             const RawValue& value,
                                                             std::int64_t least, std::int64_t most,
                                                             std::string_view range) {
  const auto number = decimal(field, value);
  if (number && (*number < least || *number > most)) {
    report(field,
           {ErrorCode::NumberOutOfRange, fmt::format("{} {}", kRowFields[field].name, range)});
  }
  return number;
}

std::optional<std::string_view> MeasurementRowReader::text(std::size_t field,
                                                           const RawValue& value) {
  const std::string_view name = kRowFields[field].name;
  const std::size_t longest = kRowFields[field].longest;
  if (value.kind != RawValue::Kind::String) {
    report(ErrorCode::FieldType, name,
           fmt::format("{} must be a string; got {}", name, name_of(value.kind)));
    return std::nullopt;
  }
  const auto* const plain = kRowFields[field].plain;
  const bool counts_characters = plain != nullptr && plain->accepted.counts_characters;
  const auto counts = [&](char c) {
    return !counts_characters || (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // UTF-8
  };
  if (value.text.size() > longest &&
      std::cmp_greater(std::ranges::count_if(value.text, counts), longest)) {
    report(ErrorCode::FieldTooLong, name,
           fmt::format("{} must have at most {} {}", name, longest,
                       counts_characters ? "characters" : "bytes"));
    return std::nullopt;
  }
  if (value.text.find('\0') != std::string_view::npos) {
    report(ErrorCode::FieldInvalid, name, fmt::format("{} must not contain a NUL character", name));
    return std::nullopt;
  }
  return value.text;
}

std::optional<std::int64_t> MeasurementRowReader::truth(std::size_t field, const RawValue& value) {
  const bool can_be = value.kind == RawValue::Kind::Boolean || value.kind == RawValue::Kind::String;
  if (can_be && ascii_iequals(value.text, "true")) return 1;
  if (!can_be || !ascii_iequals(value.text, "false")) {
    const std::string_view name = kRowFields[field].name;
    report(ErrorCode::FieldType, name, fmt::format("{} must be true or false", name));
  }
  return std::nullopt;
}

void MeasurementRowReader::take_gauge(const app::Measurement& other) { draft_.gauge_of = &other; }

const GaugeInUse* MeasurementRowReader::find_gauge(std::string_view name) {
  if (name == last_gauge_) return last_gauge_in_use_;
  const auto found = context_.gauges->find(name);
  last_gauge_ = name;
  last_gauge_in_use_ = found == context_.gauges->end() ? nullptr : &found->second;
  return last_gauge_in_use_;
}

/// Facts of a gauge in use at that time: its uncertainty, if the rule needs one and none was given,
/// and whether it was overdue or blocked. @pre measured_at is set
void MeasurementRowReader::apply_gauge() {
  app::Measurement& m = draft_.measurement;
  const bool needs = draft_.rule.kind != gauging::DecisionRule::Kind::Simple;
  if (const app::Measurement* other = draft_.gauge_of) {
    m.calibration_due = other->calibration_due;
    m.calibration_certificate = other->calibration_certificate;
    m.calibration_laboratory = other->calibration_laboratory;
    m.gauge_blocked = other->gauge_blocked;
    if (needs && !m.standard_uncertainty) {
      m.standard_uncertainty = other->standard_uncertainty;
      m.degrees_of_freedom = other->degrees_of_freedom;
      m.uncertainty_budget = other->uncertainty_budget;
    }
  }
  if (context_.gauges == nullptr || !m.gauge) return;
  const GaugeInUse* gauge = find_gauge(*m.gauge);
  const GaugePeriod* found = gauge == nullptr ? nullptr : gauge->at(m.measured_at);
  if (found == nullptr) {
    m.has_unknown_gauge = std::ranges::any_of(
        *context_.gauges, [](const auto& each) { return !each.second.deleted_at; });
    return;
  }
  const GaugePeriod& period = *found;
  if (draft_.gauge_of == nullptr && period.is_overdue(m.measured_at)) {
    m.calibration_due = period.calibration_due;
  } else if (draft_.gauge_of == nullptr && !period.is_blocked) {
    m.calibration_certificate = period.certificate;
    m.calibration_laboratory = period.laboratory;
  }
  if (draft_.gauge_of == nullptr && period.is_blocked) m.gauge_blocked = 1;
  if (needs && !m.standard_uncertainty && !given(RowField::Uncertainty) &&
      period.standard_uncertainty) {
    m.standard_uncertainty = period.standard_uncertainty;
    m.degrees_of_freedom = period.degrees_of_freedom;
    m.uncertainty_budget = period.budget;
  }
}

/// @pre every field is valid by itself, and a rule that needs the uncertainty has it
void MeasurementRowReader::apply_rule() {
  app::Measurement& m = draft_.measurement;
  draft_.rule.standard_uncertainty = m.standard_uncertainty;
  draft_.rule.added_uncertainty = m.added_uncertainty;
  draft_.rule.degrees_of_freedom = m.degrees_of_freedom;
  const auto rule = make_rule(draft_.rule);
  if (!rule) {
    const std::string_view field = kRowFields[RowField::Uncertainty].name;
    return report(rule.error().code, rule.error().where.empty() ? field : rule.error().where,
                  rule.error().message);
  }
  const auto checked =
      check_acceptance(*rule, {.upper = m.upper_limit(), .lower = m.lower_limit()});
  if (!checked) return report(RowField::Uncertainty, checked.error());
  m.rule = *rule;
  if (rule->kind() == gauging::DecisionRule::Kind::GuardBand) {
    m.coverage_factor = rule->coverage_factor();
  } else if (const auto given_factor = draft_.rule.coverage_millionths) {
    m.coverage_factor = gauging::CoverageFactor::from_millionths(*given_factor).value();
  }
}

/// @pre every field is valid by itself
void MeasurementRowReader::apply_correction() {
  app::Measurement& m = draft_.measurement;
  const auto correction = make_correction(m);
  if (!correction) {
    return report(correction.error().code, correction.error().where, correction.error().message);
  }
  if (!*correction) return;
  m.corrected = (**correction)(m.measured);
  m.added_uncertainty = (*correction)->added_uncertainty(*m.corrected);
}

void MeasurementRowReader::refuse_rule_without_limits() {
  for (const std::size_t field :
       {RowField::Uncertainty, RowField::Coverage, RowField::Rule, RowField::Probability}) {
    if (!given(field)) continue;
    report(ErrorCode::FieldConflict, kRowFields[field].name,
           fmt::format("{} needs limits: give nominal_mm with tolerance_class, designation, or "
                       "upper_um or lower_um",
                       kRowFields[field].name));
  }
}

/// Fields of ISO 14405-1, which are for sizes only, and the field of edges.
void MeasurementRowReader::apply_size() {
  app::Measurement& m = draft_.measurement;
  const bool is_size = m.quantity && gauging::has_feature(*m.quantity);
  const std::pair<std::string_view, const std::optional<std::string_view>*> given_words[] = {
      {"size_operator", &m.size_operator}, {"envelope", &m.envelope}, {"go_gauge", &m.go_gauge}};
  for (const auto& [name, value] : given_words) {
    if (*value && m.quantity && !is_size) {
      report(ErrorCode::FieldConflict, name,
             fmt::format("{} is for sizes, not for a {}", name, word(*m.quantity)));
    }
  }
  if (m.inside_corner && m.quantity && (is_size || gauging::is_signed(*m.quantity))) {
    report(ErrorCode::FieldConflict, "inside_corner",
           "inside_corner is for radii and chamfers only");
  }
  if (m.size_operator && m.size_operator->empty()) {
    report(ErrorCode::FieldInvalid, "size_operator", "size_operator must not be empty");
  }
  if (m.envelope && m.envelope != app::kEnvelopeRequired) {
    report(ErrorCode::FieldInvalid, "envelope", "envelope must be 'required', or be left out");
  }
  if (m.go_gauge && m.go_gauge != app::kGoPasses && m.go_gauge != app::kGoFails) {
    report(ErrorCode::FieldInvalid, "go_gauge", "go_gauge must be one of: passes, fails");
  } else if (m.go_gauge && !m.envelope) {
    report(ErrorCode::FieldMissing, "envelope",
           "go_gauge needs an envelope: give envelope required, or a designation with (E)");
  }
  if (is_size && !m.size_operator) m.size_operator = app::kTwoPoint;
}

const app::Measurement* MeasurementRowReader::end() {
  app::Measurement& m = draft_.measurement;
  if (!given(RowField::Measured)) {
    report(RowField::Measured, {ErrorCode::FieldMissing, "measured_mm is required"});
  }
  if (draft_.quantity) m.quantity = draft_.quantity;
  if (!draft_.has_limits) resolve_limits();
  if (draft_.measured && !is_unread(RowField::Quantity, draft_.quantity)) {
    m.measured = *draft_.measured;
    const auto checked =
        check_measured(m.measured, m.quantity.value_or(gauging::Quantity::Diameter));
    if (!checked) report(RowField::Measured, checked.error());
  }
  if (!m.is_judged()) refuse_rule_without_limits();
  apply_size();
  if (m.degrees_of_freedom && !m.standard_uncertainty && !given(RowField::Uncertainty)) {
    report(ErrorCode::FieldMissing, RowField::Uncertainty,
           "degrees_of_freedom needs uncertainty_um");
  }
  if (!given(RowField::MeasuredAt)) m.measured_at = context_.received_at;
  apply_gauge();
  if (draft_.rule.kind != gauging::DecisionRule::Kind::Simple && !m.standard_uncertainty &&
      !given(RowField::Uncertainty)) {
    report(ErrorCode::FieldMissing, RowField::Uncertainty,
           fmt::format("rule {} needs uncertainty_um, the standard uncertainty, or a gauge in use "
                       "that has an uncertainty budget",
                       word(draft_.rule.kind)));
  }
  if (!draft_.failed) apply_correction();
  if (!draft_.failed && m.is_judged()) apply_rule();
  if (draft_.failed) return nullptr;
  m.received_at = context_.received_at;
  m.caller = context_.caller;
  app::judge(m);
  return &m;
}

}  // namespace fitgauge::api

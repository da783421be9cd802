#include "api/measurement_row_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "api/verdict_codec.hpp"
#include "base/decimal.hpp"
#include "iso286/designation.hpp"

namespace fitgauge::api {
namespace {

enum Field : std::size_t {
  kMeasured,
  kNominal,
  kClass,
  kDesignation,
  kFeature,
  kUpper,
  kLower,
  kPartId,
  kCharacteristic,
  kOrder,
  kOperation,
  kMachine,
  kOperator,
  kGauge,
  kUnit,
  kComment,
  kMeasuredAt,
  kUncertainty,
  kCoverage,
  kRule,
  kTemperature,
  kFieldCount,
};

struct FieldRow {
  std::string_view name;
  std::size_t longest = 0;  ///< of a text, in bytes
};

constexpr std::size_t kIdentifier = 200;
constexpr std::size_t kComments = 2000;

/// In the order of Field.
constexpr std::array<FieldRow, kFieldCount> kFields = {{
    {"measured_mm"},
    {"nominal_mm"},
    {"tolerance_class", 64},
    {"designation", 64},
    {"feature", 16},
    {"upper_um"},
    {"lower_um"},
    {"part_id", kIdentifier},
    {"characteristic", kIdentifier},
    {"order", kIdentifier},
    {"operation", kIdentifier},
    {"machine", kIdentifier},
    {"operator", kIdentifier},
    {"gauge", kIdentifier},
    {"unit", kIdentifier},
    {"comment", kComments},
    {"measured_at", 64},
    {"uncertainty_um"},
    {"coverage_factor"},
    {"rule", 16},
    {"temperature_c"},
}};

constexpr std::int64_t kMillion = 1'000'000;
constexpr std::int64_t kLargestCoverage = 100 * kMillion;
constexpr std::int64_t kAbsoluteZero = -273'150'000;
constexpr std::int64_t kHottest = 10'000 * kMillion;

std::size_t search_field(std::string_view name) {
  const auto found = std::find_if(kFields.begin(), kFields.end(),
                                  [&](const FieldRow& field) { return field.name == name; });
  return static_cast<std::size_t>(found - kFields.begin());
}

std::string_view name_of(RawValue::Kind kind) {
  static_assert(static_cast<int>(RawValue::Kind::Object) ==
                static_cast<int>(JsonValue::Kind::Object));
  return api::name_of(static_cast<JsonValue::Kind>(kind));
}

}  // namespace

RawValue raw_value(const JsonValue& value) {
  return {.kind = static_cast<RawValue::Kind>(value.kind), .text = value.text};
}

bool MeasurementRowReader::knows(std::string_view name) { return search_field(name) < kFieldCount; }

// Rows have their fields in one order, those of one request and mostly those of the next: the n-th
// is most likely what it was before.
std::size_t MeasurementRowReader::find_field(std::string_view name) {
  static thread_local std::array<std::uint8_t, 32> order{};
  std::uint8_t& expected = order[position_++ % order.size()];
  if (kFields[expected].name == name) return expected;
  const std::size_t field = search_field(name);
  if (field < kFieldCount) expected = static_cast<std::uint8_t>(field);
  return field;
}

void MeasurementRowReader::begin(std::optional<std::size_t> row, std::optional<std::size_t> line) {
  row_ = row;
  line_ = line;
  position_ = 0;
  draft_ = {};
}

void MeasurementRowReader::report(ErrorCode code, std::string_view field, std::string message) {
  draft_.failed = true;
  std::string pointer = row_ ? pointer_to("", *row_) : std::string();
  if (!field.empty()) pointer = pointer_to(pointer, field);
  errors_.add(code, std::move(pointer), std::move(message), line_);
}

void MeasurementRowReader::report_unknown(std::string_view name) {
  report(ErrorCode::FieldUnknown, name, fmt::format("there is no field {}", name));
}

void MeasurementRowReader::report_row(ErrorCode code, std::string message) {
  report(code, "", std::move(message));
}

bool MeasurementRowReader::field(std::string_view name, const RawValue& value) {
  const std::size_t field = find_field(name);
  if (field == kFieldCount || given(field)) return false;
  draft_.given |= 1U << field;
  assign(field, value);
  return true;
}

void MeasurementRowReader::assign(std::size_t field, const RawValue& value) {
  app::Measurement& m = draft_.measurement;
  switch (field) {
    case kMeasured:
      if (const auto measured = length(field, value, false, true)) {
        m.measured = *measured;
        if (const auto checked = check_measured(*measured); !checked) {
          report(checked.error().code, kFields[field].name, checked.error().message);
        }
      }
      break;
    case kNominal: draft_.nominal = length(field, value, false); break;
    case kClass: draft_.class_name = text(field, value); break;
    case kDesignation: draft_.designation = text(field, value); break;
    case kFeature:
      if (const auto given_word = text(field, value)) {
        draft_.feature = iso286::feature_from_word(*given_word);
        if (!draft_.feature) {
          report(ErrorCode::FieldInvalid, kFields[field].name, "feature is hole or shaft");
        }
      }
      break;
    case kUpper: draft_.upper = length(field, value, true); break;
    case kLower: draft_.lower = length(field, value, true); break;
    case kPartId: m.texts.part_id = text(field, value); break;
    case kCharacteristic: m.texts.characteristic = text(field, value); break;
    case kOrder: m.texts.order = text(field, value); break;
    case kOperation: m.texts.operation = text(field, value); break;
    case kMachine: m.texts.machine = text(field, value); break;
    case kOperator: m.texts.operator_id = text(field, value); break;
    case kGauge: m.texts.gauge = text(field, value); break;
    case kUnit: m.texts.unit = text(field, value); break;
    case kComment: m.texts.comment = text(field, value); break;
    case kMeasuredAt:
      if (const auto time = text(field, value)) {
        const auto parsed = parse_rfc3339(*time);
        if (parsed) {
          m.measured_at = *parsed;
        } else {
          report(parsed.error().code, kFields[field].name, parsed.error().message);
        }
      }
      break;
    case kUncertainty:
      m.standard_uncertainty = length(field, value, true);
      if (m.standard_uncertainty && *m.standard_uncertainty < Length()) {
        report(ErrorCode::LengthOutOfRange, kFields[field].name, "an uncertainty is not negative");
      }
      break;
    case kCoverage:
      if (const auto factor = decimal(field, value)) {
        const auto made = gauging::CoverageFactor::from_millionths(*factor);
        if (made && *factor <= kLargestCoverage) {
          m.coverage_factor = *made;
        } else {
          report(ErrorCode::NumberOutOfRange, kFields[field].name,
                 "coverage_factor is above 0 and at most 100");
        }
      }
      break;
    case kRule:
      if (const auto rule = text(field, value)) {
        const auto kind = gauging::rule_from_word(*rule);
        if (kind) {
          draft_.rule = *kind;
        } else {
          report(ErrorCode::FieldInvalid, kFields[field].name, "rule is simple or guard_band");
        }
      }
      break;
    case kTemperature:
      m.temperature = decimal(field, value);
      if (m.temperature && (*m.temperature < kAbsoluteZero || *m.temperature > kHottest)) {
        report(ErrorCode::NumberOutOfRange, kFields[field].name,
               "temperature_c lies from -273.15 to 10000");
      }
      break;
    default: break;
  }
}

std::optional<Length> MeasurementRowReader::length(std::size_t field, const RawValue& value,
                                                   bool micrometres, bool round) {
  if (value.kind != RawValue::Kind::Number && value.kind != RawValue::Kind::String) {
    report(ErrorCode::FieldType, kFields[field].name,
           fmt::format("{} takes a number, not {}", kFields[field].name, name_of(value.kind)));
    return std::nullopt;
  }
  const LengthSyntax syntax{.decimal_comma = value.decimal_comma,
                            .exponent = value.kind == RawValue::Kind::Number,
                            .round_to_nearest = round};
  const auto parsed =
      micrometres ? parse_length_um(value.text, syntax) : parse_length_mm(value.text, syntax);
  if (parsed) return *parsed;
  report(parsed.error().code, kFields[field].name, parsed.error().message);
  return std::nullopt;
}

std::optional<std::int64_t> MeasurementRowReader::decimal(std::size_t field,
                                                          const RawValue& value) {
  if (value.kind != RawValue::Kind::Number && value.kind != RawValue::Kind::String) {
    report(ErrorCode::FieldType, kFields[field].name,
           fmt::format("{} takes a number, not {}", kFields[field].name, name_of(value.kind)));
    return std::nullopt;
  }
  const auto parsed = parse_decimal(value.text, {.scale = 6,
                                                 .decimal_comma = value.decimal_comma,
                                                 .exponent = value.kind == RawValue::Kind::Number});
  if (parsed) return *parsed;
  const bool too_fine = parsed.error().code == ErrorCode::LengthTooFine;
  report(too_fine ? ErrorCode::FieldInvalid : parsed.error().code, kFields[field].name,
         parsed.error().message);
  return std::nullopt;
}

std::optional<std::string_view> MeasurementRowReader::text(std::size_t field,
                                                           const RawValue& value) {
  const auto& [name, longest] = kFields[field];
  if (value.kind != RawValue::Kind::String) {
    report(ErrorCode::FieldType, name,
           fmt::format("{} takes a string, not {}", name, name_of(value.kind)));
    return std::nullopt;
  }
  if (value.text.size() > longest) {
    report(ErrorCode::FieldTooLong, name, fmt::format("{} takes at most {} bytes", name, longest));
    return std::nullopt;
  }
  if (value.text.find('\0') != std::string_view::npos) {
    report(ErrorCode::FieldInvalid, name, fmt::format("{} holds a NUL character", name));
    return std::nullopt;
  }
  return value.text;
}

void MeasurementRowReader::take_limits(const app::Measurement& other) {
  app::apply_limits(draft_.measurement, other);
  draft_.has_limits = true;
}

const app::Measurement* MeasurementRowReader::end() {
  app::Measurement& m = draft_.measurement;
  if (!given(kMeasured)) {
    report(ErrorCode::FieldMissing, kFields[kMeasured].name, "measured_mm is required");
  }
  if (!draft_.has_limits) resolve_limits();
  if (draft_.rule == gauging::DecisionRule::Kind::GuardBand) {
    if (!given(kUncertainty)) {
      report(ErrorCode::FieldMissing, kFields[kUncertainty].name,
             "the guard band needs uncertainty_um, the standard uncertainty");
    } else if (!draft_.failed) {
      m.rule = gauging::DecisionRule::guard_band(
                   *m.standard_uncertainty, m.coverage_factor.value_or(gauging::CoverageFactor()))
                   .value();
      m.coverage_factor = m.rule.coverage_factor();
    }
  }
  if (draft_.failed) return nullptr;
  m.received_at = received_at_;
  if (!given(kMeasuredAt)) m.measured_at = received_at_;
  m.caller = caller_;
  app::judge(m);
  return &m;
}

void MeasurementRowReader::resolve_limits() {
  const bool by_designation = given(kDesignation);
  const bool by_class = given(kClass);
  const bool by_drawing = given(kUpper) || given(kLower) || given(kFeature);
  const int ways = int{by_designation} + int{by_class} + int{by_drawing};
  if (ways > 1 || (by_designation && given(kNominal))) {
    const std::size_t second = by_designation ? (given(kNominal) ? kNominal
                                                 : by_class      ? kClass
                                                                 : kFeature)
                                              : kClass;
    report(ErrorCode::FieldConflict, kFields[second].name,
           "give the limits once: designation, or nominal_mm with tolerance_class, or nominal_mm "
           "with feature, upper_um and lower_um");
    return;
  }
  if (by_designation) return resolve_designation();
  if (!given(kNominal)) {
    report(ErrorCode::FieldMissing, kFields[kNominal].name,
           "nominal_mm is required, or a designation");
  }
  if (by_drawing) return resolve_explicit();
  if (by_class) return resolve_class();
  report(ErrorCode::FieldMissing, kFields[kClass].name,
         "tolerance_class is required, or feature with upper_um and lower_um");
}

Result<iso286::ClassId> MeasurementRowReader::find_class(std::string_view name) {
  if (last_class_id_ && name == last_class_) return *last_class_id_;
  const auto found = tables_.find_class(name);
  if (!found) return found.error();
  last_class_ = name;
  last_class_id_ = *found;
  return *found;
}

void MeasurementRowReader::take_limits(const Result<iso286::LimitsOfSize>& limits,
                                       std::string_view field) {
  if (limits) {
    app::apply_limits(draft_.measurement, *limits, tables_);
  } else {
    report(limits.error().code, field, limits.error().message);
  }
}

void MeasurementRowReader::resolve_class() {
  std::optional<iso286::NominalSize> size;
  if (draft_.nominal) {
    const auto made = iso286::NominalSize::make(*draft_.nominal);
    if (made) {
      size = *made;
    } else {
      report(made.error().code, kFields[kNominal].name, made.error().message);
    }
  }
  if (!draft_.class_name) return;
  const auto id = find_class(*draft_.class_name);
  if (!id) {
    report(ErrorCode::ClassUnknown, kFields[kClass].name, id.error().message);
  } else if (size) {
    take_limits(tables_.limits_of_size(*size, *id), kFields[kClass].name);
  }
}

void MeasurementRowReader::resolve_designation() {
  if (!draft_.designation) return;
  const std::string_view field = kFields[kDesignation].name;
  const auto designation = iso286::parse_designation(*draft_.designation);
  if (!designation) return report(designation.error().code, field, designation.error().message);
  const auto id = find_class(designation->class_name);
  if (!id) return report(id.error().code, field, id.error().message);
  take_limits(tables_.limits_of_size(designation->nominal_size, *id), field);
}

void MeasurementRowReader::resolve_explicit() {
  for (const std::size_t field : {kFeature, kUpper, kLower}) {
    if (!given(field)) {
      report(
          ErrorCode::FieldMissing, kFields[field].name,
          fmt::format("{} is required beside the other limits of a drawing", kFields[field].name));
    }
  }
  if (!draft_.nominal || !draft_.feature || !draft_.upper || !draft_.lower) return;
  app::Measurement& m = draft_.measurement;
  if (*draft_.nominal <= Length() || *draft_.nominal > kLargestMeasured) {
    report(ErrorCode::LengthOutOfRange, kFields[kNominal].name,
           "nominal_mm is above 0 and at most 100000000");
  }
  if (*draft_.upper < *draft_.lower) {
    report(ErrorCode::LimitsInvalid, kFields[kUpper].name, "upper_um is below lower_um");
  } else if (*draft_.nominal + *draft_.lower <= Length()) {
    report(ErrorCode::LimitsInvalid, kFields[kLower].name, "the lower limit would be 0 or less");
  }
  m.basis = app::LimitsBasis::Explicit;
  m.nominal_size = *draft_.nominal;
  m.feature = *draft_.feature;
  m.deviations = {.upper = *draft_.upper, .lower = *draft_.lower};
}

}  // namespace fitgauge::api

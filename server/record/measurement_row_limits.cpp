#include "record/measurement_row_reader.hpp"
#include "tables/iso286/tolerance_class.hpp"
#include "tables/standards/standard.hpp"

// A row gives its limits by a designation, a class with its nominal size, or limits of a drawing.

namespace fitgauge::api {
namespace {

bool is_nominal(Length nominal, gauging::Quantity quantity) {
  const bool is_above =
      gauging::is_signed(quantity) ? nominal >= -kLargestMeasured : nominal > Length();
  return is_above && nominal <= kLargestMeasured;
}

std::string nominal_range(gauging::Quantity quantity) {
  return fmt::format("nominal_mm of a {} must be {} and at most 100000000", word(quantity),
                     gauging::is_signed(quantity) ? "at least -100000000" : "above 0");
}

}  // namespace

void MeasurementRowReader::take_limits(const app::Measurement& other) {
  app::apply_limits(draft_.measurement, other);
  draft_.has_limits = true;
}

void MeasurementRowReader::resolve_limits() {
  const bool by_designation = given(RowField::Designation);
  const bool by_class = given(RowField::Class);
  // A general tolerance does not define inside or outside.
  const bool open_feature = is_open_designation() || is_open_class();
  const bool by_drawing = given(RowField::Upper) || given(RowField::Lower) ||
                          (given(RowField::Feature) && !open_feature);
  const int ways = int{by_designation} + int{by_class} + int{by_drawing};
  if (ways > 1 || (by_designation && given(RowField::Nominal))) {
    constexpr std::size_t kOthers[] = {RowField::Nominal, RowField::Class, RowField::Upper,
                                       RowField::Lower, RowField::Feature};
    const std::size_t second =
        by_designation ? *std::ranges::find_if(kOthers, [&](auto field) { return given(field); })
                       : RowField::Class;
    report(ErrorCode::FieldConflict, kRowFields[second].name,
           "give the limits once: designation, or nominal_mm with tolerance_class, or nominal_mm "
           "with feature, and upper_um, lower_um or both");
    return;
  }
  if (by_designation) return resolve_designation();
  if (ways == 0 && given(RowField::Quantity)) return resolve_none();
  if (!given(RowField::Nominal)) {
    report(ErrorCode::FieldMissing, RowField::Nominal, "nominal_mm or designation is required");
  }
  if (by_drawing) return resolve_explicit();
  if (by_class) return resolve_class();
  report(ErrorCode::FieldMissing, RowField::Class,
         "give tolerance_class, or feature with upper_um, lower_um or both; for a value without "
         "limits give quantity");
}

void MeasurementRowReader::take_quantity(gauging::Quantity of_class, bool has_others) {
  if (!draft_.quantity || *draft_.quantity == of_class) return;
  const bool is_size =
      *draft_.quantity <= gauging::Quantity::Width;  // of a slot, a key, or between two faces
  if (has_others && is_size) return;
  report(ErrorCode::FieldConflict, RowField::Quantity,
         fmt::format("the limits belong to a {}: remove quantity", word(of_class)));
}

void MeasurementRowReader::refuse_feature(gauging::Quantity quantity) {
  report(ErrorCode::FieldConflict, RowField::Feature,
         fmt::format("feature is for diameters and widths, not for a {}: remove feature",
                     word(quantity)));
}

/// A value that nothing judges.
void MeasurementRowReader::resolve_none() {
  if (!draft_.quantity) return;
  if (draft_.nominal && !is_nominal(*draft_.nominal, *draft_.quantity)) {
    report(ErrorCode::LengthOutOfRange, RowField::Nominal, nominal_range(*draft_.quantity));
  }
  app::apply_no_limits(draft_.measurement, draft_.nominal);
}

bool MeasurementRowReader::is_open_designation() const {
  return draft_.designation && standards::is_class(*draft_.designation);
}
bool MeasurementRowReader::is_open_class() const {
  return draft_.class_name && standards::is_class(*draft_.class_name);
}

void MeasurementRowReader::take_limits(Result<standards::DesignatedLimits> limits,
                                       std::string_view field) {
  if (!limits) return report(limits.error().code, field, limits.error().message);
  const gauging::Quantity quantity = app::quantity_of(*limits);
  const bool is_linear = quantity == gauging::Quantity::Distance;
  take_quantity(quantity, is_linear);
  app::Measurement& m = draft_.measurement;
  if (draft_.feature && !is_linear) refuse_feature(quantity);
  if (draft_.feature) {
    limits->feature = *draft_.feature;
    if (!m.quantity) m.quantity = gauging::Quantity::Diameter;
    if (m.quantity == quantity) refuse_feature(quantity);
  }
  app::apply_limits(m, *limits);
}

Result<iso286::ClassId> MeasurementRowReader::find_class(std::string_view name) {
  if (last_class_id_ && name == last_class_) return *last_class_id_;
  const auto found = TRY(tables_.find_class(name));
  last_class_ = name;
  last_class_id_ = found;
  return found;
}

void MeasurementRowReader::take_limits(const Result<iso286::LimitsOfSize>& limits,
                                       std::string_view field) {
  if (limits) {
    take_quantity(gauging::Quantity::Diameter, true);
    app::apply_limits(draft_.measurement, *limits, tables_);
  } else {
    report(limits.error().code, field, limits.error().message);
  }
}

void MeasurementRowReader::resolve_class() {
  if (is_open_class()) {
    if (!draft_.nominal) return;
    return take_limits(standards::limits_of(*draft_.nominal, *draft_.class_name),
                       kRowFields[RowField::Class].name);
  }
  std::optional<iso286::NominalSize> size;
  if (draft_.nominal) {
    const auto made = iso286::NominalSize::make(*draft_.nominal);
    if (made) {
      size = *made;
    } else {
      report(made.error().code, RowField::Nominal, made.error().message);
    }
  }
  if (!draft_.class_name) return;
  const auto id = find_class(*draft_.class_name);
  if (!id) {
    report(ErrorCode::ClassUnknown, RowField::Class, id.error().message);
  } else if (size) {
    take_limits(tables_.limits_of_size(*size, *id), kRowFields[RowField::Class].name);
  }
}

void MeasurementRowReader::resolve_designation() {
  if (!draft_.designation) return;
  const std::string_view field = kRowFields[RowField::Designation].name;
  if (standards::is_designation(*draft_.designation)) {
    return take_limits(standards::limits_of(*draft_.designation), field);
  }
  const auto designation = iso286::parse_designation(*draft_.designation);
  if (!designation) return report(designation.error().code, field, designation.error().message);
  if (designation->has_envelope) draft_.measurement.envelope = app::kEnvelopeRequired;
  const auto id = find_class(designation->class_name);
  if (!id) return report(id.error().code, field, id.error().message);
  take_limits(tables_.limits_of_size(designation->nominal_size, *id), field);
}

void MeasurementRowReader::resolve_explicit() {
  if (is_unread(RowField::Quantity, draft_.quantity)) return;
  const gauging::Quantity quantity = draft_.quantity.value_or(gauging::Quantity::Diameter);
  const bool has_feature = gauging::has_feature(quantity);
  if (!has_feature && given(RowField::Feature)) {
    refuse_feature(quantity);
  } else if (has_feature && !given(RowField::Feature)) {
    report(ErrorCode::FieldMissing, RowField::Feature,
           "feature (hole or shaft) is required with explicit limits");
  }
  const bool one_given = given(RowField::Upper) || given(RowField::Lower);
  if (!one_given) {
    report(ErrorCode::FieldMissing, RowField::Upper,
           "give upper_um, lower_um or both with feature; for a value without limits give quantity "
           "without feature");
  }
  const bool are_read =
      !is_unread(RowField::Upper, draft_.upper) && !is_unread(RowField::Lower, draft_.lower);
  if (!draft_.nominal || !one_given || !are_read) return;
  const Length upper = draft_.upper.value_or(app::kNoLimit);
  const Length lower = draft_.lower.value_or(-app::kNoLimit);
  app::Measurement& m = draft_.measurement;
  if (!is_nominal(*draft_.nominal, quantity)) {
    report(ErrorCode::LengthOutOfRange, RowField::Nominal, nominal_range(quantity));
  }
  if (upper < lower) {
    report(ErrorCode::LimitsInvalid, RowField::Upper, "upper_um is below lower_um");
  } else if (!gauging::is_signed(quantity) &&
             *draft_.nominal + draft_.lower.value_or(upper) <= Length()) {
    report(ErrorCode::LimitsInvalid, draft_.lower ? RowField::Lower : RowField::Upper,
           fmt::format("the {} limit must be above 0", draft_.lower ? "lower" : "upper"));
  }
  m.basis = app::LimitsBasis::Explicit;
  m.nominal_size = *draft_.nominal;
  m.quantity = quantity;
  m.feature = draft_.feature.value_or(m.feature);
  m.deviations = {.upper = upper, .lower = lower};
}

}  // namespace fitgauge::api

#pragma once

#include "base/json/field_reader.hpp"
#include "record/measurement_batch.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::api {

/// A field of a measurement in a request, whichever format it comes in.
struct RowField {
  enum Index : std::size_t {
    Measured,
    Nominal,
    Class,
    Designation,
    Feature,
    Upper,
    Lower,
    Quantity,
    Labels,
    MeasuredAt = Labels + app::kLabels.size(),
    Uncertainty,
    Coverage,
    Rule,
    Probability,
    Thermal,
    DegreesOfFreedom = Thermal + app::kThermalFields.size(),
    Kept,  ///< decides nothing, as the labels, or only of a record
    Count = Thermal + app::kGivenFields.size() - app::kLabels.size(),
  };

  enum class Kind : std::uint8_t { Length, Decimal, Text, Time, Feature, Quantity, Rule, Truth };

  std::string_view name{};
  Kind kind = Kind::Text;
  std::size_t longest = 0;  ///< of a text, in bytes
  std::string_view meaning{};
  const app::MeasurementField* plain = nullptr;  ///< stored unchanged; otherwise the reader uses it
};

/// The fields that the readers accept and /openapi.json describes, by RowField::Index.
inline constexpr std::array<RowField, RowField::Count> kRowFields = [] {
  std::array<RowField, RowField::Count> fields = {{
      {"measured_mm", RowField::Kind::Length, 0,
       "Measured value, above 0 to 100000000; a position, distance or deviation from -100000000; "
       "rounded to 1 nm"},
      {"nominal_mm", RowField::Kind::Length, 0, "Nominal size"},
      {"tolerance_class", RowField::Kind::Text, 64,
       "Tolerance class such as H7 or g6, or a custom one"},
      {"designation", RowField::Kind::Text, 64,
       "Size and class: 25 H7, 25 H7(E), M10-6H or 25 ISO 2768-m; a comma may mark decimals"},
      {"feature", RowField::Kind::Feature, 16,
       "Feature; required with explicit limits of a diameter, width or pitch diameter"},
      {"upper_um", RowField::Kind::Length, 0, "Upper deviation of explicit limits"},
      {"lower_um", RowField::Kind::Length, 0, "Lower deviation of explicit limits"},
      {"quantity", RowField::Kind::Quantity, 16,
       "Quantity (default: from the designation, else diameter); limits are then optional"},
  }};
  fields[RowField::MeasuredAt] = {
      "measured_at", RowField::Kind::Time, 64,
      "Time with an offset or Z, stored in UTC (default: time of receipt)"};
  fields[RowField::Uncertainty] = {"uncertainty_um", RowField::Kind::Length, 0,
                                   "Standard uncertainty u, 0 or more"};
  fields[RowField::Coverage] = {
      "coverage_factor", RowField::Kind::Decimal, 0,
      "Coverage factor k, above 0 to 100 (default: t(0.9545, degrees_of_freedom), else 2)"};
  fields[RowField::Rule] = {"rule", RowField::Kind::Rule, 16, "Decision rule (default: simple)"};
  fields[RowField::Probability] = {"probability", RowField::Kind::Decimal, 0,
                                   "Probability of conformance, 0.5 to below 1 (default: 0.95)"};
  std::size_t at = RowField::Labels;
  for (const app::MeasurementField& field : app::kGivenFields) {
    if (at == RowField::MeasuredAt) at = RowField::Thermal;
    using Kind = RowField::Kind;
    const Kind of_number = field.accepted.is_truth ? Kind::Truth : Kind::Decimal;
    fields.at(at++) = {field.name, field.text != nullptr ? Kind::Text : of_number,
                       field.accepted.longest, field.meaning, &field};
  }
  return fields;
}();
static_assert(kRowFields[RowField::DegreesOfFreedom].name == "degrees_of_freedom");

/// One value in its format, before it is read as a field.
struct RawValue {
  using Kind = JsonValue::Kind;

  Kind kind = Kind::Null;
  std::string_view text{};     ///< digits of a number, characters of a string, true or false
  bool decimal_comma = false;  ///< CSV with `;` or quotes
};

/// Converts a parsed JSON value. @returns a view of it.
RawValue raw_value(const JsonValue& value);

/// Turns the fields of one row into a judged measurement, whichever format they came in: begin()
/// the row, give it every field, end() it. Adds faults to the FieldErrors. Remembers the
/// last class, so that a batch of one class looks it up once. Refers to all it is given.
class MeasurementRowReader {
 public:
  MeasurementRowReader(const BatchContext& context, FieldErrors& errors)
      : tables_(context.tables), context_(context), errors_(errors) {}

  /// @param row index of the row, from 0; none for a single object.
  /// @param line line of the row, from 1; none if the format has no lines.
  void begin(std::optional<std::size_t> row, std::optional<std::size_t> line = {});

  /// @returns false, and reports nothing, when there is no such field or it was given before.
  bool field(std::string_view name, const RawValue& value);
  void report_unknown(std::string_view name);

  /// Gives the row the limits of another measurement; the row must not have limits itself.
  void take_limits(const app::Measurement& other);

  /// Gives the row the gauge data of another measurement, and does not look the gauge up.
  void take_gauge(const app::Measurement& other);

  /// The judged measurement, until the next row begins; null when the row has errors.
  const app::Measurement* end();

  /// Reports a row that is no object.
  void report_row(ErrorCode code, std::string message);

  /// Whether a row has a field of that name.
  static bool knows(std::string_view name);

 private:
  /// Fields of a row before the form of its limits is known.
  struct Draft {
    app::Measurement measurement{};
    std::uint64_t given = 0;  ///< a bit a field
    std::optional<Length> measured{};
    std::optional<Length> nominal{};
    std::optional<std::string_view> class_name{};
    std::optional<std::string_view> designation{};
    std::optional<iso286::Feature> feature{};
    std::optional<gauging::Quantity> quantity{};
    std::optional<Length> upper{};
    std::optional<Length> lower{};
    RuleWords rule{};
    bool has_limits = false;                     ///< copied from another measurement
    const app::Measurement* gauge_of = nullptr;  ///< of take_gauge
    bool failed = false;
  };

  std::size_t find_field(std::string_view name);
  void assign(std::size_t field, const RawValue& value);
  bool check_number(std::size_t field, const RawValue& value);
  std::optional<Length> length(std::size_t field, const RawValue& value, bool micrometres,
                               bool round = false);
  /// Returns the number in millionths, or in the unit of the field.
  std::optional<std::int64_t> decimal(std::size_t field, const RawValue& value);
  /// A decimal number between the two, as decimal() returns it. @param range both bounds in words
  std::optional<std::int64_t> decimal_in(std::size_t field, const RawValue& value,
                                         std::int64_t least, std::int64_t most,
                                         std::string_view range);
  std::optional<std::string_view> text(std::size_t field, const RawValue& value);
  std::optional<std::int64_t> truth(std::size_t field, const RawValue& value);
  bool given(std::size_t field) const { return (draft_.given >> field & 1) != 0; }
  /// Whether the field was given and is reported already.
  template <class T>
  bool is_unread(std::size_t field, const std::optional<T>& value) const {
    return given(field) && !value;
  }

  void apply_gauge();
  const GaugeInUse* find_gauge(std::string_view name);
  void apply_rule();
  void apply_correction();
  void resolve_limits();
  void resolve_class();
  void resolve_designation();
  void resolve_explicit();
  void resolve_none();
  /// Reports a quantity that a class of limits is not for.
  void take_quantity(gauging::Quantity of_class, bool has_others);
  void refuse_feature(gauging::Quantity quantity);
  void refuse_rule_without_limits();
  void apply_size();
  void take_limits(const Result<iso286::LimitsOfSize>& limits, std::string_view field);
  void take_limits(Result<standards::DesignatedLimits> limits, std::string_view field);
  bool is_open_designation() const;
  bool is_open_class() const;
  Result<iso286::ClassId> find_class(std::string_view name);
  /// @param field none: the whole row
  void report(ErrorCode code, std::optional<std::string_view> field, std::string message);
  void report(ErrorCode code, RowField::Index field, std::string message) {
    report(code, kRowFields[field].name, std::move(message));
  }
  void report(std::size_t field, const Error& error);

  const iso286::ToleranceTables& tables_;
  const BatchContext& context_;
  FieldErrors& errors_;
  std::optional<std::size_t> row_;
  std::optional<std::size_t> line_;
  Draft draft_;
  std::size_t position_ = 0;  ///< fields of the row so far
  std::string last_gauge_;
  const GaugeInUse* last_gauge_in_use_ = nullptr;
  std::string last_class_;
  std::optional<iso286::ClassId> last_class_id_;  ///< none before the first: "" is no class
};

// The fast way into a batch, for plain well-formed JSON. It takes no key with an escape, no nested
// value and no duplicate key, and is strict where simdjson's on-demand reading is not (it hands out
// number tokens unchecked). Where it returns false, the exact reader decides what is wrong, so both
// accept the same texts.

/// Reads a whole body: an object or an array of objects. False may leave rows in the batch.
/// @param body followed by http::Request::kBodyPadding readable bytes.
bool read_body_fast(std::string_view body, const BatchContext& context, MeasurementBatch& batch,
                    FieldErrors& errors);

/// Reads one object into one row. Call reader.begin() before. If false, the batch is unchanged.
/// @param object followed by as many readable bytes as the function above needs
bool read_object_fast(std::string_view object, MeasurementRowReader& reader,
                      MeasurementBatch& batch);

}  // namespace fitgauge::api

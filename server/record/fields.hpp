#pragma once

#include "metrology/gauging/gauge.hpp"

namespace fitgauge::app {

/// The source of a measurement: a gauge at a part, or the simulated machine.
enum class Source : std::uint8_t { Gauge, Simulation };
inline constexpr std::string_view kSourceWords[] = {"gauge", "simulation"};
/// Source of the limits: a class of the tables, a custom tolerance class, the drawing, or a
/// designation of another standard; None: a value without limits; Bare: also without a nominal
/// size.
enum class LimitsBasis : std::uint8_t { Iso286, Custom, Explicit, Standard, None, Bare };
inline constexpr std::string_view kBasisWords[] = {"iso286",   "custom", "explicit",
                                                   "standard", "none",   "none"};

/// Texts and numbers of a measurement that are stored, logged and answered as they are. Texts are
/// views of the memory that they were read from.
struct MeasurementFields {
  Source source = Source::Gauge;
  /// None in records of versions that stored diameters and positions alike.
  std::optional<gauging::Quantity> quantity{};
  iso286::Feature feature = iso286::Feature::Hole;
  LimitsBasis basis = LimitsBasis::Iso286;

  std::optional<std::string_view> part_id{};
  std::optional<std::string_view> characteristic{};
  std::optional<std::string_view> order{};
  std::optional<std::string_view> operation{};
  std::optional<std::string_view> machine{};
  std::optional<std::string_view> operator_id{};
  std::optional<std::string_view> gauge{};
  std::optional<std::string_view> unit{};
  std::optional<std::string_view> comment{};
  std::optional<std::string_view> subgroup{};
  std::optional<std::string_view> tool{};

  // In millionths of a degree Celsius, and of µm/(m·K):
  std::optional<std::int64_t> temperature{};
  std::optional<std::int64_t> scale_temperature{};
  std::optional<std::int64_t> part_expansion{};
  std::optional<std::int64_t> scale_expansion{};
  std::optional<std::string_view> part_material{};  ///< instead of the expansion
  std::optional<std::string_view> scale_material{};
  // Standard uncertainties of temperatures and expansions, in their units:
  std::optional<std::int64_t> temperature_uncertainty{};
  std::optional<std::int64_t> scale_temperature_uncertainty{};
  std::optional<std::int64_t> part_expansion_uncertainty{};
  std::optional<std::int64_t> scale_expansion_uncertainty{};

  std::optional<std::int64_t> offset{};              ///< a correction made before this part, in nm
  std::optional<std::int64_t> confirmed{};           ///< 1: a person confirmed a far value
  std::optional<std::int64_t> inside_corner{};       ///< 1: of a radius or chamfer
  std::optional<std::int64_t> degrees_of_freedom{};  ///< of the uncertainty, in millionths
  std::optional<std::string_view> size_operator{};   ///< of ISO 14405-1: LP, GG
  std::optional<std::string_view> envelope{};        ///< `required`
  std::optional<std::string_view> go_gauge{};        ///< `passes` or `fails`, of the envelope

  std::optional<std::string_view> caller{};   ///< name of the API key that stored it
  std::optional<std::int64_t> run_id{};       ///< the run of a simulated measurement
  std::optional<std::int64_t> cycle{};        ///< number of its measuring cycle
  std::optional<std::int64_t> points{};       ///< that it touched
  std::optional<std::int64_t> start_angle{};  ///< of the first, in millionths of a degree
  std::optional<std::int64_t>
      diameter_factor{};  ///< scatter of the diameter divided by the scatter of a touch, in 1e-6
  std::optional<std::int64_t> form{};                   ///< deviation of form that they show, in nm
  std::optional<std::string_view> correction_reason{};  ///< of a correction, and of no other
  std::optional<std::string_view> uncertainty_budget{};       ///< of the gauge, if it gave u
  std::optional<std::string_view> calibration_due{};          ///< of the gauge, if overdue
  std::optional<std::string_view> calibration_certificate{};  ///< of the gauge, if in date
  std::optional<std::string_view> calibration_laboratory{};   ///< the same
  std::optional<std::int64_t> gauge_blocked{};      ///< 1: the gauge was blocked when it measured
  std::optional<std::int64_t> added_uncertainty{};  ///< by the correction to 20 °C, in pm
};

/// Values that a request may give a field; none if the service fills it.
struct Accepted {
  std::size_t longest = 0;  ///< of a text, in bytes, or in characters if it counts those
  // Bounds of a number, in units of 10^-scale, and in words:
  std::int64_t least = 0;
  std::int64_t most = 0;
  std::string_view range{};
  bool is_thermal = false;  ///< the field corrects to 20 °C
  bool is_truth = false;    ///< a number that is 1 for true; false is as good as not given
  bool counts_characters = false;

  constexpr bool nothing() const { return longest == 0 && most == 0; }
};

inline constexpr std::size_t kLongestIdentifier = 200;
inline constexpr std::size_t kLongestComment = 2000;
/// Measures of a note that set its value aside and count it again; the newest of them decides.
inline constexpr std::string_view kSetAside = "set aside";
inline constexpr std::string_view kCountedAgain = "counted again";
inline constexpr Accepted kIdentifier{.longest = kLongestIdentifier};
inline constexpr Accepted kRemark{.longest = kLongestComment};
inline constexpr Accepted kMaterialName{.longest = 64, .is_thermal = true};
inline constexpr Accepted kCelsius{.least = gauging::kColdest,
                                   .most = gauging::kHottest,
                                   .range = "must be from -273.15 to 10000",
                                   .is_thermal = true};
inline constexpr Accepted kExpansion{
    .most = gauging::kLargestExpansion, .range = "must be from 0 to 1000", .is_thermal = true};
inline constexpr Accepted kThermalUncertainty{
    .most = gauging::kLargestUncertainty, .range = "must be from 0 to 1000", .is_thermal = true};
inline constexpr Accepted kOffset{
    .least = -1'000'000'000, .most = 1'000'000'000, .range = "must be from -1000000 to 1000000"};
inline constexpr Accepted kDegreesOfFreedom{
    .least = 1'000'000, .most = 1'000'000'000'000, .range = "must be from 1 to 1000000"};
inline constexpr Accepted kSizeOperator{.longest = 8, .counts_characters = true};
inline constexpr Accepted kEnvelopeWord{.longest = 16};
inline constexpr Accepted kTruth{.most = 1, .is_truth = true};
inline constexpr Accepted kNotGiven{};
inline constexpr Accepted kTruthNotGiven{.is_truth = true};

/// A member of MeasurementFields: a text, or a number in units of 10^-scale.
struct FieldMember {
  using Text = std::optional<std::string_view> MeasurementFields::*;
  using Number = std::optional<std::int64_t> MeasurementFields::*;

  constexpr FieldMember(Text of) : text(of) {}        // NOLINT(google-explicit-constructor)
  constexpr FieldMember(Number of, int scale_of = 0)  // NOLINT(google-explicit-constructor)
      : number(of), scale(scale_of) {}

  Text text = nullptr;  ///< either the text
  Number number = nullptr;
  int scale = 0;
};

/// Describes a field of MeasurementFields for reading, writing, storing and documents.
struct MeasurementField : FieldMember {
  std::string_view name;    ///< in requests, records and tables
  std::string_view column;  ///< in the store
  int place = 0;            ///< of the column in CSV and XLSX, from 1 on; never changed
  Accepted accepted{};
  std::string_view meaning{};  ///< of a field that a request may give
  int filter = 0;              ///< number in the index of the store, never changed; 0: no filter
};

/// The place of a filter: the index has other fields from 12 to 15.
constexpr std::size_t filter_place(int number) {
  return static_cast<std::size_t>(number > 15 ? number - 5 : number - 1);
}

using Of = MeasurementFields;
constexpr FieldMember scaled(FieldMember::Number member, int scale) { return {member, scale}; }

/// Every field once, in this order: labels, fields for the correction to 20 °C, other fields of a
/// request, and fields that the service fills.
inline constexpr MeasurementField kMeasurementFields[] = {
    {&Of::part_id, "part_id", "part_id", 22, kIdentifier, "Part id, such as a serial number", 1},
    {&Of::characteristic, "characteristic", "characteristic", 23, kIdentifier,
     "Measured characteristic of the part", 3},
    {&Of::order, "order", "work_order", 24, kIdentifier, "Work order", 2},
    {&Of::operation, "operation", "operation", 25, kIdentifier, "Step of the routing", 5},
    {&Of::machine, "machine", "machine", 26, kIdentifier, "Machine that made the part", 4},
    {&Of::operator_id, "operator", "operator", 27, kIdentifier, "Operator", 6},
    {&Of::gauge, "gauge", "gauge", 28, kIdentifier, "Gauge of the measurement", 7},
    {&Of::unit, "unit", "unit", 29, kIdentifier, "Line, cell or plant", 8},
    {&Of::comment, "comment", "comment", 30, kRemark, "Free text"},
    {&Of::subgroup, "subgroup", "subgroup", 31, kIdentifier,
     "Subgroup of parts that were made together", 11},
    {&Of::tool, "tool", "tool", 65, kIdentifier, "Tool in the spindle that cut the part", 16},

    {scaled(&Of::temperature, 6), "temperature_c", "temperature", 21, kCelsius,
     "Temperature of the part, -273.15 to 10000; needs its expansion or material"},
    {scaled(&Of::scale_temperature, 6), "scale_temperature_c", "scale_temperature", 41, kCelsius,
     "Temperature of the scale (default: 20)"},
    {scaled(&Of::part_expansion, 6), "part_expansion_um_per_m_k", "part_expansion", 42, kExpansion,
     "Expansion of the part in µm/(m K), 0 to 1000"},
    {scaled(&Of::scale_expansion, 6), "scale_expansion_um_per_m_k", "scale_expansion", 43,
     kExpansion, "Expansion of the scale in µm/(m K)"},
    {&Of::part_material, "part_material", "part_material", 44, kMaterialName,
     "Material of the part, such as steel, instead of part_expansion_um_per_m_k"},
    {&Of::scale_material, "scale_material", "scale_material", 45, kMaterialName,
     "Material of the scale, instead of scale_expansion_um_per_m_k"},
    {scaled(&Of::temperature_uncertainty, 6), "temperature_uncertainty_c",
     "temperature_uncertainty", 49, kThermalUncertainty,
     "Standard uncertainty of temperature_c, 0 or more; adds to uncertainty_um"},
    {scaled(&Of::scale_temperature_uncertainty, 6), "scale_temperature_uncertainty_c",
     "scale_temperature_uncertainty", 50, kThermalUncertainty,
     "Standard uncertainty of scale_temperature_c"},
    {scaled(&Of::part_expansion_uncertainty, 6), "part_expansion_uncertainty_um_per_m_k",
     "part_expansion_uncertainty", 51, kThermalUncertainty,
     "Standard uncertainty of the part's expansion (default: from the source of the material)"},
    {scaled(&Of::scale_expansion_uncertainty, 6), "scale_expansion_uncertainty_um_per_m_k",
     "scale_expansion_uncertainty", 52, kThermalUncertainty,
     "Standard uncertainty of the scale's expansion"},

    {scaled(&Of::degrees_of_freedom, 6), "degrees_of_freedom", "degrees_of_freedom", 56,
     kDegreesOfFreedom, "Degrees of freedom of uncertainty_um, 1 to 1000000 (default: infinite)"},

    {scaled(&Of::offset, 3), "offset_um", "offset_nm", 54, kOffset,
     "Correction of the machine before this part, -1000000 to 1000000"},
    {&Of::size_operator, "size_operator", "size_operator", 57, kSizeOperator,
     "Size operator of ISO 14405-1, length in characters (default: LP, two-point)"},
    {&Of::envelope, "envelope", "envelope", 58, kEnvelopeWord,
     "required: the size has the modifier (E) of ISO 14405-1"},
    {&Of::go_gauge, "go_gauge", "go_gauge", 59, kEnvelopeWord,
     "passes or fails: result of the GO gauge, which verifies the envelope"},
    {&Of::confirmed, "confirmed", "confirmed", 66, kTruth,
     "true: a person confirmed a value far outside the limits"},
    {&Of::inside_corner, "inside_corner", "inside_corner", 70, kTruth,
     "true: the radius or chamfer is that of an inside corner, where one too large is rework"},

    {&Of::caller, "caller", "caller", 32, kNotGiven, {}, 10},
    {&Of::cycle, "cycle", "cycle", 34, kNotGiven},
    {&Of::points, "points", "points", 61, kNotGiven},
    {scaled(&Of::start_angle, 6), "start_angle_deg", "start_angle", 62, kNotGiven},
    {scaled(&Of::diameter_factor, 6), "diameter_factor", "diameter_factor", 63, kNotGiven},
    {&Of::correction_reason, "reason", "correction_reason", 36, kNotGiven},
    {&Of::uncertainty_budget, "uncertainty", "uncertainty_budget", 46, kNotGiven},
    {&Of::calibration_due, "calibration_due", "calibration_due", 47, kNotGiven},
    {&Of::calibration_certificate, "calibration_certificate", "calibration_certificate", 67,
     kNotGiven},
    {&Of::calibration_laboratory, "calibration_laboratory", "calibration_laboratory", 68,
     kNotGiven},
    {&Of::gauge_blocked, "gauge_blocked", "gauge_blocked", 69, kTruthNotGiven},
    {scaled(&Of::added_uncertainty, 6), "added_uncertainty_um", "added_uncertainty", 53, kNotGiven},
};

/// Calls `visit(field, member)` with each field and its pointer, as straight code.
template <class Visit>
constexpr void for_each_plain(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto one = [&]<std::size_t K>() {
      constexpr const MeasurementField& kField = kMeasurementFields[K];
      if constexpr (kField.text != nullptr) {
        visit(kField, kField.text);
      } else {
        visit(kField, kField.number);
      }
    };
    (one.template operator()<I>(), ...);
  }
  (std::make_index_sequence<std::size(kMeasurementFields)>());
}

/// Fields that a request may give.
inline constexpr auto kGivenFields =
    std::span(kMeasurementFields)
        .first(static_cast<std::size_t>(std::ranges::count_if(
            kMeasurementFields, [](const MeasurementField& f) { return !f.accepted.nothing(); })));
/// Texts that identify a measurement and have no effect on it.
inline constexpr auto kLabels = kGivenFields.first(static_cast<std::size_t>(
    std::ranges::find_if(kGivenFields, [](const auto& f) { return f.number != nullptr; }) -
    kGivenFields.begin()));

/// Fields that correct a reading to 20 °C.
inline constexpr auto kThermalFields = kGivenFields.subspan(
    kLabels.size(),
    static_cast<std::size_t>(std::ranges::count_if(
        kGivenFields, [](const MeasurementField& f) { return f.accepted.is_thermal; })));

/// Names of the texts that lists filter and summaries group by, in the order of their numbers. The
/// tolerance class is stored in another form than the caller gives it.
inline constexpr auto kTextFilters = [] {
  constexpr auto kCount =
      1 + std::ranges::count_if(kMeasurementFields, [](const auto& f) { return f.filter != 0; });
  std::array<std::string_view, static_cast<std::size_t>(kCount)> names{};
  names.fill("tolerance_class");
  for (const MeasurementField& field : kMeasurementFields) {
    if (field.filter != 0) names.at(filter_place(field.filter)) = field.name;
  }
  return names;
}();
inline constexpr auto kOfCharacteristic = static_cast<std::size_t>(
    std::ranges::find(kTextFilters, "characteristic") - kTextFilters.begin());
inline constexpr auto kOfMachine =
    static_cast<std::size_t>(std::ranges::find(kTextFilters, "machine") - kTextFilters.begin());

}  // namespace fitgauge::app

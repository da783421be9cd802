#pragma once

#include "api/services.hpp"
#include "base/json/body_forms.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// Reads a designation of ISO 286, or of another standard with tables here.
/// @errors those of iso286::parse_designation and standards::limits_of.
Result<store::DesignationFilter> parse_designation(std::string_view text);

/// Limits of size in an answer. Its views are of the tables or the standard.
struct LimitsAnswer {
  std::optional<std::string> designation{};
  Length nominal{};
  std::optional<std::string_view> tolerance_class{};
  iso286::Feature feature{};
  iso286::LimitDeviations deviations{};
  std::optional<iso286::NominalSizeRange> size_range{};
  std::string_view basis{};
  std::optional<std::string_view> table_revision{};
};
LimitsAnswer limits_answer(const iso286::LimitsOfSize& limits,
                           const iso286::ToleranceTables& tables);
LimitsAnswer limits_answer(const standards::DesignatedLimits& limits);

/// The form of the basis of limits.
struct Basis : Text {
  std::string schema(Side) const {
    return schema::words({"iso286", "custom", "explicit", "standard"});
  }
};

void members(auto& v, const iso286::NominalSizeRange& range) {
  v.member("over", range.over, Millimetres{}, "Exclusive");
  v.member("up_to", range.up_to, Millimetres{}, "Inclusive");
}
void members(auto& v, const LimitsAnswer& limits) {
  const auto& [upper, lower] = limits.deviations;
  v.optional("designation", limits.designation,
             "Size and class; absent with the limits of a drawing");
  v.member("nominal_mm", limits.nominal, Millimetres{}, "Nominal size");
  v.optional("tolerance_class", limits.tolerance_class, "Absent for limits of a drawing");
  v.member("feature", limits.feature, OneOf<2>{"hole", "shaft"},
           "A hole is too small before it is too large, a shaft the other way");
  v.member("upper_deviation_um", upper, Micrometres{}, "ES or es");
  v.member("lower_deviation_um", lower, Micrometres{}, "EI or ei");
  v.member("upper_limit_mm", limits.nominal + upper, Millimetres{}, "Largest good size, inclusive");
  v.member("lower_limit_mm", limits.nominal + lower, Millimetres{},
           "Smallest good size, inclusive");
  v.member("tolerance_um", upper - lower, Micrometres{}, "Upper minus lower limit");
  v.optional("size_range_mm", limits.size_range, "Step of the standard tolerance");
  v.member("basis", limits.basis, Basis{},
           "ISO 286, a custom tolerance class, a drawing, or a designation of another standard");
  v.optional("table_revision", limits.table_revision, "The tables the limits were taken from");
}

/// `25 H7`
std::string designation_text(Length nominal_size, std::string_view class_name);

/// 200 with a JSON text and its entity tag with the release, which may compute another answer.
Response tagged_json(std::string body, std::string etag);

/// Entity tag of results from the tables: it changes with their revision.
std::string etag_of(const iso286::ToleranceTables& tables);
std::string etag_of(const standards::Standard& standard);

}  // namespace fitgauge::api

#include "api/schemas.hpp"

namespace fitgauge::api {

using schema::Others;

schema::Fields limits_fields() {
  const std::string range = schema::object(
      {{"over", schema::number(), "Exclusive"}, {"up_to", schema::number(), "Inclusive"}});
  return {
      {"designation", schema::text(), "Size and class; absent with the limits of a drawing", false},
      {"nominal_mm", schema::number(), "Nominal size"},
      {"tolerance_class", schema::text(), "Absent with the limits of a drawing", false},
      {"feature", feature_words(),
       "A hole is too small before it is too large, a shaft the other way"},
      {"upper_deviation_um", schema::number(), "ES or es"},
      {"lower_deviation_um", schema::number(), "EI or ei"},
      {"upper_limit_mm", schema::number(), "Largest good size, inclusive"},
      {"lower_limit_mm", schema::number(), "Smallest good size, inclusive"},
      {"tolerance_um", schema::number(), "Upper minus lower limit"},
      {"size_range_mm", range, "Step of the standard tolerance", false},
      {"basis", schema::words({"iso286", "custom", "explicit"}),
       "The standard, a column of the shop's own, or a drawing"},
      {"table_revision", schema::text(), "The tables the limits were taken from", false},
  };
}

schema::Fields verdict_fields() {
  return {
      {"measured_mm", schema::number(), "As it is stored: rounded to 1 nm"},
      {"deviation_um", schema::number(), "Measured minus nominal size"},
      {"verdict", verdict_words(),
       "rework: hole too small, shaft too large; reject: hole too large, shaft too small"},
      {"excess_um", schema::number(),
       "Beyond the upper limit (positive) or the lower limit (negative); 0 inside"},
  };
}

void add_limits_schemas(Schemas& schemas) {
  constexpr std::string_view kLimits =
      R"({"designation":"25 H7","nominal_mm":25,"tolerance_class":"H7","feature":"hole",)"
      R"("upper_deviation_um":21,"lower_deviation_um":0,"upper_limit_mm":25.021,"lower_limit_mm":25,)"
      R"("tolerance_um":21,"size_range_mm":{"over":18,"up_to":30},"basis":"iso286",)"
      R"("table_revision":"1-f0a85b3a"})";
  constexpr std::string_view kVerdict =
      R"({"designation":"25 H7","nominal_mm":25,"tolerance_class":"H7","feature":"hole",)"
      R"("upper_deviation_um":21,"lower_deviation_um":0,"upper_limit_mm":25.021,"lower_limit_mm":25,)"
      R"("tolerance_um":21,"size_range_mm":{"over":18,"up_to":30},"basis":"iso286",)"
      R"("table_revision":"1-f0a85b3a","measured_mm":25.0215,"deviation_um":21.5,)"
      R"("verdict":"reject","excess_um":0.5})";
  schemas.push_back({"Limits", schema::object(limits_fields(), Others::Allowed, kLimits)});
  schemas.push_back(
      {"Fit", schema::object({
                  {"designation", schema::text(), "25 H7/g6"},
                  {"hole", schema::ref("Limits"), ""},
                  {"shaft", schema::ref("Limits"), ""},
                  {"type", schema::words({"clearance", "transition", "interference"}), ""},
                  {"max_clearance_um", schema::number(), "ES - ei; negative: interference"},
                  {"min_clearance_um", schema::number(), "EI - es; negative: interference"},
              })});
  const schema::Fields rule = schema::optional({
      {"rule", rule_words(), "Where it is not simple"},
      {"uncertainty_um", schema::number(), "Standard uncertainty u of the rule"},
      {"coverage_factor", schema::number(), "k of the rule"},
  });
  schemas.push_back({"Verdict", schema::object(limits_fields() + verdict_fields() + rule,
                                               Others::Allowed, kVerdict)});
}

}  // namespace fitgauge::api

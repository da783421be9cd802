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
      {"basis", schema::words({"iso286", "custom", "explicit", "standard"}),
       "ISO 286, a column of the shop's own, a drawing, or a designation of another standard"},
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

namespace {

void add_found_fits(Schemas& schemas, const schema::Fields& fit_fields) {
  const std::string fit =
      schema::object(fit_fields + schema::Fields{
                                      {"hole_class", schema::text(), ""},
                                      {"shaft_class", schema::text(), ""},
                                      {"preferred", schema::boolean(), "By ISO 286-1, figure B.2"},
                                  });
  schemas.push_back({"FoundFits", schema::object({{"fits", schema::array(fit), "The first"},
                                                  {"total", schema::count(), "All there are"}})});
}

void add_limit_gauge(Schemas& schemas) {
  const schema::Fields sizes = {{"upper_mm", schema::number(), "New"},
                                {"lower_mm", schema::number(), "New"}};
  const schema::Fields wear = {{"wear_limit_mm", schema::number(), "Worn out"}};
  schemas.push_back({"LimitGauge", schema::object({
                                       {"designation", schema::text(), ""},
                                       {"formula", schema::text(), "What was computed"},
                                       {"clause", schema::text(), "Where that is from"},
                                       {"scheme", schema::text(), "The standard of the values"},
                                       {"note", schema::text(), "On other editions"},
                                       {"kind", schema::words({"plug", "ring or snap"}), ""},
                                       {"upper_limit_mm", schema::number(), "Of the workpiece"},
                                       {"lower_limit_mm", schema::number(), "Of the workpiece"},
                                       {"go", schema::object(sizes + wear), ""},
                                       {"no_go", schema::object(sizes), ""},
                                   })});
}

void add_standards(Schemas& schemas) {
  const schema::Fields identity = {
      {"name", schema::text(), "iso2768-1"},
      {"edition", schema::text(), "ISO 2768-1:1989"},
      {"title", schema::text(), ""},
      {"revision", schema::text(), "The table_revision of what is judged by it"},
      {"designation", schema::text(), "An example; absent where it has none for limits", false},
      {"left_out", schema::text(), "What the standard has beside this, and why it is not here",
       false}};
  const std::string standard =
      schema::object(identity + schema::Fields{
                                    {"tables", schema::array(schema::text()), ""},
                                    {"sources", schema::array(schema::text()), "Compared with"},
                                });
  schemas.push_back({"Standards", schema::object({{"standards", schema::array(standard), ""}})});
  const std::string item = schema::object(schema::optional({
      {"designation", schema::text(), "Of ISO 286, of the width of a keyway"},
      {"nominal_mm", schema::number(), ""},
      {"upper_um", schema::number(), "Upper deviation"},
      {"lower_um", schema::number(), "Lower deviation"},
      {"tolerance_um", schema::number(), ""},
      {"deviation_um", schema::number(),
       "Of the position of a thread, the one next to its profile"},
      {"upper_arcmin", schema::number(), "In minutes"},
      {"lower_arcmin", schema::number(), "In minutes"},
  }));
  const std::string row = schema::object(
      schema::Fields{{"table", schema::text(), ""}, {"limits", schema::map(item), "By item"}} +
      schema::optional({{"over_mm", schema::number(), "Exclusive"},
                        {"up_to_mm", schema::number(), "Inclusive; absent: without end"},
                        {"pitch_mm", schema::number(), ""},
                        {"diameter_mm", schema::number(), ""}}));
  schemas.push_back(
      {"Standard", schema::object(identity + schema::Fields{{"rows", schema::array(row), ""}})});
}

void add_press_fit(Schemas& schemas) {
  constexpr double kMost = 1e9;
  const std::string positive = schema::number(0, kMost);
  const schema::Fields material = schema::optional({
      {"youngs_modulus_mpa", schema::with_default(positive, "210000"), ""},
      {"poisson_ratio", schema::with_default(schema::number(0, 0.5), "0.3"), ""},
      {"rz_um", schema::with_default(positive, "0"), "Roughness, pressed flat in part"},
  });
  const schema::Fields outer = {{"outer_diameter_mm", positive, ""}};
  const schema::Fields inner = {
      {"inner_diameter_mm", schema::with_default(positive, "0"), "0: solid", false}};
  schemas.push_back(
      {"PressFitOrder",
       schema::object(
           {
               {"joint_diameter_mm", positive, ""},
               {"length_mm", positive, ""},
               {"friction", schema::with_default(positive, "0.12"), "Along the joint", false},
               {"hub", schema::object(outer + material, Others::Refused), ""},
               {"shaft", schema::object(inner + material, Others::Refused), ""},
               {"min_interference_um", schema::with_default(positive, "0"), "", false},
               {"max_interference_um", positive, ""},
           },
           Others::Refused)});
  const std::string pressed = schema::object({
      {"interference_um", schema::number(), ""},
      {"effective_interference_um", schema::number(), "Less what the roughness takes"},
      {"pressure_mpa", schema::number(), "In the joint"},
      {"hub_stress_mpa", schema::number(), "Equivalent stress in the bore (von Mises)"},
      {"shaft_stress_mpa", schema::number(), "Likewise"},
      {"axial_force_n", schema::number(), "At which it slips"},
      {"torque_nm", schema::number(), "At which it slips"},
  });
  schemas.push_back(
      {"PressFit",
       schema::object(formula_fields() + schema::Fields{{"method", schema::text(), ""},
                                                        {"at_min_interference", pressed, ""},
                                                        {"at_max_interference", pressed, ""}})});
}

}  // namespace

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
  const std::string likely =
      schema::object({{"probability_of_interference", schema::number(), ""}});
  const std::string side = schema::object(
      selection_field() + schema::Fields{{"mean", schema::number(), "In mm"},
                                         {"standard_deviation_overall", schema::number(), "In mm"},
                                         {"stable", schema::boolean(), "No rule is broken"}});
  const std::string stored = schema::object(
      {{"probability_of_interference", schema::number(), "Independent and normal, as measured"},
       {"mean_clearance_um", schema::number(), ""},
       {"standard_deviation_um", schema::number(), "Of the clearance"},
       {"stable", schema::boolean(), "Both are: else the next parts may be others"},
       {"hole", side, ""},
       {"shaft", side, ""}});
  const std::string statistical =
      schema::object({{"normal", likely, "Six standard deviations wide"},
                      {"uniform", likely, ""},
                      {"stored", stored, "Of the values that filters choose", false}});
  const schema::Fields fit_members = {
      {"designation", schema::text(), "25 H7/g6"},
      {"hole", schema::ref("Limits"), ""},
      {"shaft", schema::ref("Limits"), ""},
      {"type", schema::words({"clearance", "transition", "interference"}), ""},
      {"max_clearance_um", schema::number(), "ES - ei; negative: interference"},
      {"min_clearance_um", schema::number(), "EI - es; negative: interference"},
      {"statistical", statistical, "Sizes independent; centred but where stored"},
  };
  const schema::Fields fit = fit_members + formula_fields();
  schemas.push_back({"Fit", schema::object(fit)});
  add_found_fits(schemas, fit);
  add_limit_gauge(schemas);
  add_standards(schemas);
  add_press_fit(schemas);
  const schema::Fields rule = schema::optional({
      {"corrected_mm", schema::number(),
       "The size at 20 °C, which decides, where an expansion is given"},
      {"added_uncertainty_um", schema::number(),
       "Standard uncertainty that the correction adds to uncertainty_um, where one of a "
       "temperature or expansion is given; the rule decides with both"},
      {"rule", rule_words(), "Where it is not simple"},
      {"uncertainty_um", schema::number(), "Standard uncertainty u of the rule"},
      {"coverage_factor", schema::number(), "k of guard_band"},
      {"probability", schema::number(0.5, 1), "Of conformance: what a good part has at least"},
      {"conformance_probability", schema::number(0, 1), "Of the part, to 1e-9"},
      {"guard_band_um", schema::number(), "Of conformance: inside both limits"},
  });
  schemas.push_back({"Verdict", schema::object(limits_fields() + verdict_fields() + rule,
                                               Others::Allowed, kVerdict)});
}

}  // namespace fitgauge::api

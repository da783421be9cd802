#include "api/limits/limits_codec.hpp"

#include "api/resources.hpp"

namespace fitgauge::api {

Result<store::DesignationFilter> parse_designation(std::string_view text) {
  if (standards::is_designation(text)) {
    const auto limits = TRY(standards::limits_of(text));
    return store::DesignationFilter{limits.nominal.count(), std::string(limits.tolerance_class)};
  }
  auto designation = TRY(iso286::parse_designation(text));
  return store::DesignationFilter{designation.nominal_size.length().count(),
                                  std::move(designation.class_name), designation.has_envelope};
}

LimitsAnswer limits_answer(const iso286::LimitsOfSize& limits,
                           const iso286::ToleranceTables& tables) {
  const std::string_view class_name = tables.class_name(limits.class_id);
  const Length nominal = limits.nominal_size.length();
  return {.designation = designation_text(nominal, class_name),
          .nominal = nominal,
          .tolerance_class = class_name,
          .feature = limits.feature,
          .deviations = limits.deviations,
          .size_range = limits.size_range,
          .basis = word(limits.basis),
          .table_revision = tables.revision().id};
}

LimitsAnswer limits_answer(const standards::DesignatedLimits& limits) {
  return {.designation = limits.designation(),
          .nominal = limits.nominal,
          .tolerance_class = limits.tolerance_class,
          .feature = limits.feature,
          .deviations = limits.deviations,
          .size_range = limits.size_range,
          .basis = word(app::LimitsBasis::Standard),
          .table_revision = limits.standard->revision};
}

std::string designation_text(Length nominal_size, std::string_view class_name) {
  std::string text = format_mm(nominal_size);
  text += ' ';
  return text += class_name;
}

Response tagged_json(std::string body, std::string etag) {
  Response response(200, "application/json", std::move(body));
  response.etag = etag.insert(etag.size() - 1, '.' + std::string(kVersion));
  return response;
}

std::string etag_of(const iso286::ToleranceTables& tables) {
  return '"' + tables.revision().id + '"';
}

std::string etag_of(const standards::Standard& standard) {
  std::string tag = '"' + standard.revision + '"';
  std::ranges::replace(tag, ' ', '-');  // a tag has no blank
  return tag;
}

std::string quantity_words() {
  return schema::words({gauging::kQuantityWords.begin(), gauging::kQuantityWords.end()});
}

schema::Fields limits_fields() {
  BodySchema describe(Side::Answer);
  members(describe, LimitsAnswer{});
  return describe.fields();
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

schema::Fields warnings_field() {
  const std::string warning =
      schema::object({{"code", schema::text(),
                       "rule.no_acceptance, uncertainty.large, gauge.unknown, gauge.overdue, "
                       "gauge.blocked, query.unused"},
                      {"detail", schema::text(), "Cause, and what to do"}});
  return {{"warnings", schema::array(warning), "Warnings of this response; not part of a record",
           false}};
}

namespace {

void add_found_fits(Schemas& schemas, const schema::Fields& fit_fields) {
  const std::string fit = schema::object(
      fit_fields + schema::Fields{
                       {"hole_class", schema::text(), ""},
                       {"shaft_class", schema::text(), ""},
                       {"preferred", schema::boolean(), "By ISO 286-1:2010, figures B.2 and B.3"},
                   });
  schemas.push_back(
      {"FoundFits", schema::object({{"fits", schema::array(fit), "The first fits in this order"},
                                    {"total", schema::count(), "Number of all fits found"}})});
}

void add_standards(Schemas& schemas) {
  const schema::Fields identity = {
      {"name", schema::text(), "iso2768-1"},
      {"edition", schema::text(), "ISO 2768-1:1989"},
      {"title", schema::text(), ""},
      {"revision", schema::text(), "The table_revision of what is judged by it"},
      {"designation", schema::text(), "An example; absent if the standard has no limits", false},
      {"left_out", schema::text(), "Parts of the standard that are not available, with the reason",
       false}};
  const std::string standard =
      schema::object(identity + schema::Fields{
                                    {"tables", schema::array(schema::text()), ""},
                                    {"sources", schema::array(schema::text()),
                                     "Sources that the numbers were compared with"},
                                });
  schemas.push_back({"Standards", schema::object({{"standards", schema::array(standard), ""}})});
  const std::string item = schema::object(schema::optional({
      {"designation", schema::text(), "ISO 286 designation of the keyway's width"},
      {"nominal_mm", schema::number(), ""},
      {"upper_um", schema::number(), "Upper deviation"},
      {"lower_um", schema::number(), "Lower deviation"},
      {"tolerance_um", schema::number(), ""},
      {"deviation_um", schema::number(), "Deviation of a thread next to its profile"},
      {"upper_arcmin", schema::number(), "Limit in minutes of arc"},
      {"lower_arcmin", schema::number(), "Limit in minutes of arc"},
  }));
  const std::string row = schema::object(
      schema::Fields{{"table", schema::text(), ""},
                     {"limits", schema::map(item), "Limits by item"}} +
      schema::optional({{"over_mm", schema::number(), "Exclusive"},
                        {"up_to_mm", schema::number(), "Inclusive; absent if the range has no end"},
                        {"pitch_mm", schema::number(), ""},
                        {"diameter_mm", schema::number(), ""}}));
  schemas.push_back(
      {"Standard", schema::object(identity + schema::Fields{{"rows", schema::array(row), ""}})});
}

}  // namespace

void add_limits_schemas(Schemas& schemas) {
  schemas.push_back({"Limits", schema::object(limits_fields())});
  const std::string likely =
      schema::object({{"probability_of_interference", schema::number(), ""}});
  const std::string statistical =
      schema::object({{"normal", likely, "Six standard deviations wide"},
                      {"uniform", likely, ""},
                      {"stored", stored_clearance_schema(),
                       "Distributions of the values that the filters select", false}});
  const schema::Fields fit_members = {
      {"designation", schema::text(), "25 H7/g6"},
      {"hole", schema::ref("Limits"), ""},
      {"shaft", schema::ref("Limits"), ""},
      {"type", schema::words({"clearance", "transition", "interference"}), ""},
      {"max_clearance_um", schema::number(), "ES - ei; negative: interference"},
      {"min_clearance_um", schema::number(), "EI - es; negative: interference"},
      {"assumes_envelope", schema::boolean(),
       "True: form counts too unless both sizes have the modifier (E) of ISO 14405-1"},
      {"statistical", statistical,
       "Independent sizes, centred within their limits if no stored values are given"},
  };
  const schema::Fields fit = fit_members + formula_fields();
  schemas.push_back({"Fit", schema::object(fit)});
  add_found_fits(schemas, fit);
  add_standards(schemas);
  add_gauges_schemas(schemas);
  const schema::Fields rule = schema::optional({
      {"corrected_mm", schema::number(),
       "The size at 20 °C, which decides if an expansion is given"},
      {"added_uncertainty_um", schema::number(),
       "Standard uncertainty that the correction adds to uncertainty_um, if an uncertainty of a "
       "temperature or expansion is given; the rule uses both"},
      {"rule", rule_words(), "Decision rule if it is not simple"},
      {"uncertainty_um", schema::number(), "Standard uncertainty u of the rule"},
      {"degrees_of_freedom", schema::number(),
       "Degrees of freedom of uncertainty_um; absent if not given"},
      {"coverage_factor", schema::number(), "Coverage factor k of guard_band"},
      {"probability", schema::number(0.5, 1),
       "Least probability of conformance of a good part (rule conformance)"},
      {"conformance_probability", schema::number(0, 1),
       "Probability that the part conforms, to 1e-9"},
      {"guard_band_um", schema::number(), "Guard band inside both limits (rule conformance)"},
      {"envelope", schema::words({app::kEnvelopeRequired}), "Present if the designation has (E)"},
      {"envelope_result", schema::words({"not_verified"}), "Not verified by a GO gauge"},
  });
  schemas.push_back(
      {"Verdict", schema::object(limits_fields() + verdict_fields() + rule + warnings_field())});
}

}  // namespace fitgauge::api

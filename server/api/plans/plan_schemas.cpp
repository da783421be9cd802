#include "api/plans/plan_codec.hpp"
#include "api/schemas.hpp"
#include "formats/step/plan.hpp"

namespace fitgauge::api {
namespace {

using schema::Fields;
using schema::Others;

constexpr std::string_view kExample =
    R"({"part":"4711-A","name":"Bearing housing","characteristics":[)"
    R"({"name":"bore-A","designation":"25 H7","gauge":"G-07","reaction":"Stop, tell the setter"},)"
    R"({"name":"journal-C","designation":"30 k6","subgroup_size":5,"frequency":"each hour"}]})";

Fields characteristic_fields() {
  return Fields{{"name", schema::text(200), "What a measurement says as its characteristic"}} +
         schema::optional({
             {"designation", schema::text(64), "Size and class: 25 H7"},
             {"nominal_mm", schema::exact(), "With tolerance_class, or limits of a drawing"},
             {"tolerance_class", schema::text(64), ""},
             {"feature", feature_words(), "Of a drawing's own limits"},
             {"upper_um", schema::exact(), "Upper deviation of a drawing's own limits"},
             {"lower_um", schema::exact(), "Lower deviation of a drawing's own limits"},
             {"quantity", quantity_words(), "What is measured; a diameter when absent"},
             {"count", schema::integer(1, 10000), "Of features that have this size: 4 of 4X"},
             {"entity", schema::text(32), "The dimension of the drawing that it came from: #120"},
             {"gauge", schema::text(200), "What it is measured with"},
             {"rule", rule_words(), "Decision rule; simple when absent"},
             {"uncertainty_um", schema::exact(),
              "Standard uncertainty u, which a guard band needs"},
             {"coverage_factor", schema::exact(), "k; 2 when absent"},
             {"subgroup_size", schema::integer(1, 25), "Values of a sample; 1 when absent"},
             {"frequency", schema::text(200),
              "How often: every 5th part, 3 of each hour; other words are due at each part"},
             {"picture", schema::text(200), "A file of /v1/files"},
             {"reaction", schema::text(2000), "What to do when it is not good"},
             {"catalogue", schema::text(200),
              "A value that is not good waits for a cause and a measure of this catalogue"},
         });
}

}  // namespace

void add_plan_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<step::Drawing>("Drawing"));
  schemas.push_back(answer_schema<step::DrawnPlan>("DrawnPlan"));
  const Fields name = {{"name", schema::text(200), "Of the part", false},
                       {"drawing",
                        schema::object({{"digest", schema::text(64), "SHA-256 of its file"},
                                        {"part", schema::text(200), "Its product", false}},
                                       Others::Refused),
                        "The STEP file that characteristics with an entity came from", false}};
  const Fields characteristics = {
      {"characteristics",
       schema::array(schema::object(characteristic_fields(), Others::Refused), 1,
                     kMostCharacteristics),
       "In the order of measuring, 1 to 500, each with a name and limits of its own"}};
  schemas.push_back(
      {"PlanOrder", schema::object(Fields{{"part", schema::text(200), "As in the path", false}} +
                                       name + characteristics,
                                   Others::Refused, kExample)});
  schemas.push_back({"Plan", schema::object(Fields{{"part", schema::text(200), "As in the path"}} +
                                                name + characteristics,
                                            Others::Allowed, kExample)});
  schemas.push_back(
      {"Plans",
       schema::object({{"plans",
                        schema::array(schema::object(
                            {{"part", schema::text(), "As in the path"},
                             {"name", schema::text(), "", false},
                             {"characteristics", schema::count(), "How many"},
                             {"modified_at", schema::time(), "When it was stored, in UTC"}})),
                        "By part number"}},
                      Others::Allowed,
                      R"({"plans":[{"part":"4711-A","name":"Bearing housing","characteristics":2,)"
                      R"("modified_at":"2026-11-20T07:00:00Z"}]})")});
}

}  // namespace fitgauge::api

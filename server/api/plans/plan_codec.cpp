#include "api/plans/plan_codec.hpp"

#include "api/resources.hpp"
#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "formats/step/drawing.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLongestText = 200;
constexpr std::size_t kLongestReaction = 2000;
constexpr std::int64_t kLargestSubgroup = 25;
constexpr std::int64_t kMostAlike = 10'000;
constexpr std::size_t kLongestEntity = 32;

/// Fields that a measurement of the characteristic copies.
constexpr std::array<std::string_view, 14> kMeasurementFields = {
    "designation", "nominal_mm",    "tolerance_class", "feature",        "upper_um",
    "lower_um",    "quantity",      "gauge",           "uncertainty_um", "coverage_factor",
    "rule",        "size_operator", "envelope",        "inside_corner"};

void check_length(FieldReader& reader, std::string_view name,
                  const std::optional<std::string>& text, std::size_t longest) {
  if (text && text->size() > longest) {
    reader.report(ErrorCode::FieldTooLong, name, fmt::format("at most {} bytes", longest));
  }
}

void read_text(FieldReader& reader, std::string_view name, std::size_t longest) {
  check_length(reader, name, reader.optional_text(name), longest);
}

void read_own_fields(FieldReader& reader, std::set<std::string>& names) {
  const auto name = reader.text("name");
  check_length(reader, "name", name, kLongestText);
  if (name && name->empty())
    reader.report(ErrorCode::FieldInvalid, "name", "name must not be empty");
  if (name && !names.insert(*name).second) {
    reader.report(ErrorCode::FieldConflict, "name",
                  "another characteristic of the plan has this name");
  }
  reader.integer_or("subgroup_size", 1, 1, kLargestSubgroup);
  read_text(reader, "frequency", kLongestText);
  read_text(reader, "picture", kLongestText);
  read_text(reader, "reaction", kLongestReaction);
  read_text(reader, "catalogue", kLongestText);
  reader.integer_or("count", 1, 1, kMostAlike);
  read_text(reader, "entity", kLongestEntity);
}

/// Judges some value as a measurement of the characteristic would be.
void check_limits(const JsonValue& characteristic, std::size_t index, const BatchContext& context,
                  FieldErrors& errors) {
  FieldErrors found;
  MeasurementRowReader row(context, found);
  row.begin(index);
  row.field("measured_mm", {.kind = RawValue::Kind::Number, .text = "1"});
  for (const std::string_view name : kMeasurementFields) {
    if (const JsonValue* value = characteristic.find(name)) row.field(name, raw_value(*value));
  }
  row.end();
  const auto error = found.take();
  if (!error) return;
  for (const Error& each : error->details) {
    errors.add(each.code, "/characteristics" + each.where, each.message);
  }
}

void read_characteristic(const JsonValue& value, std::size_t index, const BatchContext& context,
                         std::set<std::string>& names, FieldErrors& errors) {
  FieldReader reader(value, pointer_to("/characteristics", index), errors);
  if (!value.is(JsonValue::Kind::Object)) return;
  for (const std::string_view name : kMeasurementFields) reader.optional(name);
  read_own_fields(reader, names);
  reader.refuse_unknown();
  check_limits(value, index, context, errors);
}

void read_characteristics(const JsonValue& list, const BatchContext& context, FieldReader& plan,
                          FieldErrors& errors) {
  if (list.items.empty() || list.items.size() > kMostCharacteristics) {
    plan.report(ErrorCode::FieldInvalid, "characteristics",
                fmt::format("a plan must have 1 to {} characteristics", kMostCharacteristics));
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    read_characteristic(list.items[i], i, context, names, errors);
  }
}

std::string stored_text(const JsonValue& body, std::string_view part) {
  return json_object([&](JsonWriter& json) {
    json.member("part", part);
    for (const auto& [name, value] : body.members) {
      if (name != "part") write_json(json.key(name), value);
    }
  });
}

using schema::Fields;
using schema::Others;

Fields characteristic_fields() {
  return Fields{{"name", schema::text(200), "Name, as in the characteristic of a measurement"}} +
         schema::optional({
             {"designation", schema::text(64), "Size and class: 25 H7"},
             {"nominal_mm", schema::exact(),
              "Nominal size, with tolerance_class or limits of a drawing"},
             {"tolerance_class", schema::text(64), ""},
             {"feature", feature_words(), "Feature of a drawing's own limits"},
             {"upper_um", schema::exact(), "Upper deviation of explicit limits"},
             {"lower_um", schema::exact(), "Lower deviation of explicit limits"},
             {"quantity", quantity_words(), "Quantity (default: diameter)"},
             {"size_operator", schema::text(8), "Size operator of ISO 14405-1 (default: LP)"},
             {"envelope", schema::words({app::kEnvelopeRequired}), "As (E) behind a designation"},
             {"inside_corner", schema::boolean(), "true: a radius or chamfer of an inside corner"},
             {"count", schema::integer(1, 10000), "Number of features with this size: 4 of 4X"},
             {"entity", schema::text(32), "The dimension of the drawing that it came from: #120"},
             {"gauge", schema::text(200), "Gauge"},
             {"rule", rule_words(), "Decision rule (default: simple)"},
             {"uncertainty_um", schema::exact(),
              "Standard uncertainty u, which a guard band needs"},
             {"coverage_factor", schema::exact(), "k (default: 2)"},
             {"subgroup_size", schema::integer(1, 25), "Number of values of a sample (default: 1)"},
             {"frequency", schema::text(200),
              "How often: every 5th part, 3 of each hour; other words are due at each part"},
             {"picture", schema::text(200), "A file of /v1/files"},
             {"reaction", schema::text(2000), "Action if a value is not good"},
             {"catalogue", schema::text(200),
              "A value that is not good waits for a cause and an action of this catalogue"},
         });
}

}  // namespace

Result<std::string> read_plan(const JsonValue& body, std::string_view part,
                              const BatchContext& context) {
  FieldErrors errors;
  FieldReader plan(body, "", errors);
  if (body.is(JsonValue::Kind::Object)) {
    const auto named = plan.optional_text("part");
    if (named && *named != part) {
      plan.report(ErrorCode::FieldConflict, "part", "part must be the part number of the path");
    }
    read_text(plan, "name", kLongestText);
    read_text(plan, "part_pattern", kLongestText);
    if (plan.has("drawing")) {
      if (const JsonValue* drawing = plan.object("drawing")) {
        FieldReader fields(*drawing, "/drawing", errors);
        check_length(fields, "digest", fields.text("digest"), 64);
        read_text(fields, "part", kLongestText);
        fields.refuse_unknown();
      }
    }
    if (const JsonValue* list = plan.array("characteristics")) {
      read_characteristics(*list, context, plan, errors);
    }
    plan.refuse_unknown();
  }
  if (auto error = errors.take()) return std::move(*error);
  return stored_text(body, part);
}

Result<PlanHead> read_plan_head(std::string_view text) {
  const auto plan = TRY(parse_stored_json(text, "plan"));
  return PlanHead{.name = std::string(plan.text_of("name")),
                  .characteristics = plan.member("characteristics").items.size()};
}

void add_plan_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<step::Drawing>("Drawing"));
  schemas.push_back(answer_schema<step::DrawnPlan>("DrawnPlan"));
  const Fields name = {
      {"name", schema::text(200), "Name of the part", false},
      {"part_pattern", schema::text(200),
       "Numbers of its parts, as SN-####: # a figure, ? a character, * any text", false},
      {"drawing",
       schema::object({{"digest", schema::text(64), "SHA-256 of its file"},
                       {"part", schema::text(200), "Part number of the product", false}},
                      Others::Refused),
       "The STEP file that characteristics with an entity came from", false}};
  const Fields characteristics = {
      {"characteristics",
       schema::array(schema::object(characteristic_fields(), Others::Refused), 1,
                     kMostCharacteristics),
       "1 to 500 in the order of measuring, with different names"}};
  schemas.push_back({"PlanOrder", schema::object(Fields{{"part", schema::text(200),
                                                         "Name, as in the path", false}} +
                                                     name + characteristics,
                                                 Others::Refused)});
  schemas.push_back(
      {"Plan", schema::object(Fields{{"part", schema::text(200), "Name, as in the path"}} + name +
                              characteristics)});
  schemas.push_back(
      {"Plans",
       schema::object({{"plans",
                        schema::array(schema::object(
                            {{"part", schema::text(), "Name, as in the path"},
                             {"name", schema::text(), "", false},
                             {"characteristics", schema::count(), "Number of characteristics"},
                             {"modified_at", schema::time(), "Time of storing, in UTC"}})),
                        "Sorted by part number"}})});
}

}  // namespace fitgauge::api

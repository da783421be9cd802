#include "api/service/document_routes.hpp"
#include "formats/step/drawing.hpp"
#include "record/measurement_row_reader.hpp"
#include "service/jobs.hpp"
#include "service/measurements/gauges_in_use.hpp"

namespace fitgauge::api {
namespace {

// A plan: the characteristics of a part in their order.

constexpr std::size_t kMostCharacteristics = 500;
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
  if (text && text->size() > longest)
    reader.report(ErrorCode::FieldTooLong, name, "{} must have at most {} bytes", name, longest);
}

void read_text(FieldReader& reader, std::string_view name, std::size_t longest) {
  check_length(reader, name, reader.optional_text(name), longest);
}

void read_own_fields(FieldReader& reader, std::set<std::string>& names) {
  const auto name = reader.text("name");
  check_length(reader, "name", name, kLongestText);
  if (name && name->empty())
    reader.report(ErrorCode::FieldInvalid, "name", "name must not be empty");
  if (name && name->find('\0') != std::string::npos)
    reader.report(ErrorCode::FieldInvalid, "name", "name must not contain a NUL character");
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
  for (const Error& each : error->details)
    errors.add(each.code, "/characteristics" + each.where, each.message);
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
                "a plan must have 1 to {} characteristics", kMostCharacteristics);
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.items.size(); ++i)
    read_characteristic(list.items[i], i, context, names, errors);
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

/// Checks a plan and returns its stored text: `part` first, the rest as written. Every
/// characteristic must be valid for a measurement: its limits exist, its rule has its numbers, its
/// name is unique.
/// @errors RequestInvalid with every bad field.
Result<std::string> read_plan(const JsonValue& body, std::string_view part,
                              const BatchContext& context) {
  FieldErrors errors;
  FieldReader plan(body, "", errors);
  if (body.is(JsonValue::Kind::Object)) {
    const auto named = plan.optional_text("part");
    if (named && *named != part)
      plan.report(ErrorCode::FieldConflict, "part", "part must be the part number of the path");
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
    if (const JsonValue* list = plan.array("characteristics"))
      read_characteristics(*list, context, plan, errors);
    plan.refuse_unknown();
  }
  if (auto error = errors.take()) return std::move(*error);
  return stored_text(body, part);
}

constexpr std::size_t kLongestJson = std::size_t{1} << 20;
constexpr std::size_t kLongestDrawing = std::size_t{64} << 20;
/// Maximum number of instances in a drawing over HTTP; each takes eight bytes.
constexpr std::size_t kMostInstances = std::size_t{2} << 20;
constexpr std::string_view kStep = "model/step";

Result<CheckedDocument> check_plan(const Services& services, const std::string& part,
                                   std::string_view text) {
  if (text.size() > kLongestJson) {
    return Error{ErrorCode::BodyTooLarge, "a plan must have at most 1048576 bytes"};
  }
  const auto body = TRY(parse_json(text));
  const auto tables = TRY(services.tables.tables());
  const auto gauges = services.gauges.book();
  auto plan = TRY(
      read_plan(body, part,
                {.tables = *tables, .received_at = services.clock.now(), .gauges = gauges.get()}));
  return CheckedDocument{.text = std::move(plan)};
}

Result<step::Drawing> drawing_of(const Services& services, const FileText& text) {
  const auto tables = TRY(services.tables.tables());
  return step::read_drawing(text, *tables, kMostInstances);
}

/// Makes the plan of a drawing, with the members that people added to the characteristics of the
/// stored plan.
/// @param stored receives the text of that plan; empty if there is none
Result<step::DrawnPlan> drawn_plan(const Services& services, const step::Drawing& drawing,
                                   const std::string& part, std::string& stored) {
  auto found = services.documents.wait_for(app::DocumentKind::Plan, part);
  if (!found && found.error().code == ErrorCode::PlanUnknown)
    return step::plan_of(drawing, part, nullptr);
  if (!found) return found.error();
  stored = std::move(found->text);
  const auto before = parse_stored_json(stored, "plan");
  return before ? step::plan_of(drawing, part, &*before) : before.error();
}

Result<CheckedDocument> check_drawn(const Services& services, const std::string& part,
                                    const FileText& text) {
  const auto drawing = TRY(drawing_of(services, text));
  std::string stored;
  const auto plan = TRY(drawn_plan(services, drawing, part, stored));
  auto checked = TRY(check_plan(services, part, plan.text));
  checked.answer = body_json(plan);
  checked.before = std::move(stored);
  return checked;
}

Result<Response> drawing_answer(const Services& services, const Request& request) {
  auto drawing = TRY(drawing_of(services, request.file_body()));
  if (const auto part = request.text("part"); part && !drawing.sizes.empty()) {
    std::string stored;
    auto plan = TRY(drawn_plan(services, drawing, std::string(*part), stored));
    if (!stored.empty()) drawing.compared = std::move(plan.compared);
  }
  return json_response(body_json(drawing));
}

void read_drawing(const Services& services, const Request& request, Responder responder) {
  services.jobs.figures.run([&services, &request] { return drawing_answer(services, request); },
                            answer_by(share(std::move(responder))));
}

/// @errors StorageCorrupt.
Result<void> describe_plan(JsonWriter& json, const app::NamedDocument& document) {
  const auto plan = TRY(parse_stored_json(document.text, "plan"));
  json.member("part", document.name);
  if (const std::string_view name = plan.text_of("name"); !name.empty()) json.member("name", name);
  json.member("characteristics", std::uint64_t{plan.member("characteristics").items.size()});
  return {};
}

constexpr KindOfDocument kPlans{.kind = app::DocumentKind::Plan,
                                .path = "/v1/plans",
                                .parameter = "part*",
                                .one = "a plan",
                                .contents = "what is measured at a part, in order",
                                .many = "plans of part numbers",
                                .member = "plans",
                                .operation = "Plan",
                                .operations = "Plans",
                                .body_schema = "PlanOrder",
                                .answered = "DrawnPlan",
                                .describe = describe_plan,
                                .check = check_plan,
                                .other_type = kStep,
                                .longest_other = kLongestDrawing,
                                .check_other = check_drawn};

}  // namespace

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

void add_plans_routes(Routes& add) {
  add_document_routes(add, kPlans);
  add("POST /v1/drawings readDrawing viewer 422", read_drawing,
      {.summary = "Read the sizes of a STEP drawing",
       .description = "AP242, AP203 or AP214 with product manufacturing information. Nothing is "
                      "stored: PUT the file to /v1/plans/{part} to make a plan of it.",
       .parameters = {query("part", "Part number of a plan to compare its characteristics with")},
       .body = {.use = http::BodyUse::Required,
                .media_types = {std::string(kStep)},
                .limit = kLongestDrawing,
                .spools = true,
                .when_too_large = "`fitgauge plan from FILE` reads larger drawings"},
       .outcomes = {
           {.meaning = "Sizes that were read, and content that was not", .schema = "Drawing"}}});
}

}  // namespace fitgauge::api

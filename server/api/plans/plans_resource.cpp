#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "api/plans/plan_codec.hpp"
#include "api/service/document_routes.hpp"
#include "formats/step/drawing.hpp"
#include "service/jobs.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLongestJson = std::size_t{1} << 20;
constexpr std::size_t kLongestDrawing = std::size_t{64} << 20;
/// Maximum number of instances in a drawing over HTTP; each takes eight bytes.
constexpr std::size_t kMostInstances = std::size_t{2} << 20;
constexpr std::string_view kStep = "model/step";

Result<CheckedDocument> check_plan(const Services& services, const std::string& part,
                                   std::string_view text) {
  if (text.size() > kLongestJson) {
    return Error{ErrorCode::BodyTooLarge,
                 "a plan in JSON must have at most 1048576 bytes; send a drawing as model/step"};
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
  auto checked = check_plan(services, part, plan.text);
  if (!checked) return checked.error();
  checked->answer = body_json(plan);
  checked->before = std::move(stored);
  return checked;
}

Result<http::Response> drawing_answer(const Services& services, const http::Request& request) {
  auto drawing = TRY(drawing_of(services, request.file_body()));
  if (const auto part = request.text("part"); part && !drawing.sizes.empty()) {
    std::string stored;
    auto plan = TRY(drawn_plan(services, drawing, std::string(*part), stored));
    if (!stored.empty()) drawing.compared = std::move(plan.compared);
  }
  return json_response(body_json(drawing));
}

void read_drawing(const Services& services, const http::Request& request,
                  http::Responder responder) {
  services.jobs.figures.run([&services, &request] { return drawing_answer(services, request); },
                            answer_by(share(std::move(responder))));
}

Result<void> describe_plan(JsonWriter& json, const app::NamedDocument& plan) {
  const auto head = TRY(read_plan_head(plan.text));
  json.member("part", plan.name);
  if (!head.name.empty()) json.member("name", head.name);
  json.member("characteristics", static_cast<std::uint64_t>(head.characteristics));
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

void add_plans_routes(Routes& add) {
  add_document_routes(add, kPlans);
  add("POST /v1/drawings readDrawing viewer", read_drawing,
      {.summary = "Read the sizes of a STEP drawing",
       .description = "AP242, AP203 or AP214 with product manufacturing information. Nothing is "
                      "stored: PUT the file to /v1/plans/{part} to make a plan of it.",
       .parameters = {{.name = "part",
                       .description = "Part number of a plan to compare its characteristics with"}},
       .body = {.use = http::BodyUse::Required,
                .media_types = {std::string(kStep)},
                .limit = kLongestDrawing,
                .spools = true,
                .when_too_large = "`fitgauge plan from FILE` reads larger drawings"},
       .outcomes = {{.meaning = "Sizes that were read, and content that was not",
                     .schema = "Drawing"}},
       .refusals = {422}});
}

}  // namespace fitgauge::api

#include "api/resources.hpp"

#include "api/plans/plan_codec.hpp"
#include "api/service/document_routes.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::api {
namespace {

Result<CheckedDocument> check_plan(const Services& services, const std::string& part,
                                   std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  const auto tables = services.tables.tables();
  if (!tables) return tables.error();
  const auto gauges = services.gauges.book();
  auto plan =
      read_plan(*body, part,
                {.tables = **tables, .received_at = services.clock.now(), .gauges = gauges.get()});
  if (!plan) return plan.error();
  return CheckedDocument{.text = *std::move(plan)};
}

Result<void> describe_plan(JsonWriter& json, const app::NamedDocument& plan) {
  const auto head = read_plan_head(plan.text);
  if (!head) return head.error();
  json.member("part", plan.name);
  if (!head->name.empty()) json.member("name", head->name);
  json.member("characteristics", static_cast<std::uint64_t>(head->characteristics));
  return {};
}

constexpr KindOfDocument kPlans{.kind = app::DocumentKind::Plan,
                                .path = "/v1/plans",
                                .parameter = "part*",
                                .one = "a plan",
                                .contents = "what is measured at a part, in order",
                                .many = "plans of part numbers",
                                .member = "plans",
                                .tag = "plans",
                                .operation = "Plan",
                                .operations = "Plans",
                                .schema = "Plan",
                                .body_schema = "PlanOrder",
                                .list_schema = "Plans",
                                .describe = describe_plan,
                                .check = check_plan};

}  // namespace

void add_plans_routes(std::vector<http::Route>& routes, const Services& services) {
  add_document_routes(routes, services, kPlans);
}

}  // namespace fitgauge::api

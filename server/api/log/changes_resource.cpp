#include <iterator>

#include "api/handlers.hpp"
#include "api/resources.hpp"
#include "api/schemas.hpp"
#include "base/json/json_writer.hpp"
#include "service/log/changes.hpp"
#include "service/log/log_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kKinds[] = {"tables", "plan",       "budget",    "gauge", "calibration",
                                       "setup",  "connection", "catalogue", "key"};

std::optional<std::string> text_of(const http::Request& request, std::string_view name) {
  const auto given = request.text(name);
  return given ? std::optional<std::string>(*given) : std::nullopt;
}
std::optional<std::int64_t> time_of(const http::Request& request, std::string_view name) {
  const auto given = request.time(name);
  return given ? std::optional(given->nanoseconds) : std::nullopt;
}

void list_changes(const Services& services, const http::Request& request,
                  http::Responder responder) {
  services.log.changes(
      {.kind = text_of(request, "kind"),
       .name = text_of(request, "name"),
       .from_ns = time_of(request, "from"),
       .to_ns = time_of(request, "to")},
      request.integer("after").value_or(0), request.integer("limit").value_or(100),
      [shared = share(std::move(responder))](const Result<store::ChangesStore::Page>& page) {
        if (!page) return shared->fail(page.error());
        std::string body;
        JsonWriter json(body);
        json.begin_object().key("changes").begin_array();
        for (const store::Change& change : page->changes) json.raw(app::change_json(change));
        json.end_array().key("next");
        page->has_more ? json.value(std::to_string(page->changes.back().id)) : json.null();
        json.end_object();
        shared->answer({200, "application/json", std::move(body)});
      });
}

}  // namespace

void add_changes_schemas(Schemas& schemas) {
  const std::string content = schema::null_or(schema::object({}));
  schemas.push_back(
      {"Change",
       schema::object(
           {{"id", schema::count(), "From 1 on, without gaps"},
            {"at", schema::time(), "In UTC"},
            {"caller", schema::null_or(schema::text()), "The name of the key; null: none"},
            {"kind", schema::words({std::begin(kKinds), std::end(kKinds)}), ""},
            {"name", schema::text(), "Of the document, key, gauge or column"},
            {"action", schema::words({"created", "replaced", "deleted", "revoked"}), ""},
            {"before", content, "As it was; null where it was not there"},
            {"after", content, "As it is; null where it is gone"}})});
  schemas.push_back(
      {"Changes", schema::object({{"changes", schema::array(schema::ref("Change")), "Oldest first"},
                                  {"next", schema::null_or(schema::text()),
                                   "For `after`; null on the last page"}})});
}

void add_changes_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/changes",
      .handler = with(services, list_changes),
      .summary = "What was changed of all that decides, by whom, with before and after",
      .description =
          "Tables, plans, budgets, gauges, calibrations, setups, catalogues, connections "
          "and keys, without secrets. A change is never altered or deleted.",
      .parameters = {{.name = "kind",
                      .type = http::Words{{std::begin(kKinds), std::end(kKinds)}},
                      .description = "Of this kind"},
                     {.name = "name", .description = "With exactly this name"},
                     {.name = "from", .type = http::Time{}, .description = "From then on"},
                     {.name = "to", .type = http::Time{}, .description = "Before then"},
                     {.name = "limit",
                      .type = http::Integer{1, 1000},
                      .description = "Changes of a page, fewer of long ones; 100 when absent"},
                     {.name = "after",
                      .type = http::Integer{0},
                      .description = "`next` of the page before"}},
      .access = "viewer",
      .operation = "listChanges",
      .tag = "log",
      .outcomes = {{.meaning = "A page, oldest first", .schema = "Changes"}},
  });
}

}  // namespace fitgauge::api

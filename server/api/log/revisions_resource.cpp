#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "service/log/revisions_text.hpp"
#include "service/revisions/revision_feed.hpp"

namespace fitgauge::api {
namespace {

void get_revisions(const Services& services, const http::Request& request,
                   http::Responder responder) {
  services.revisions.read(
      request.text("station").value_or(""), std::string(request.text("after").value_or("")),
      [shared = share(std::move(responder))](const Result<app::RevisionPage>& page) {
        if (!page) return shared->fail(page.error());
        shared->answer(http::Response(200, "application/json", revisions_text(*page))
                           .with("Cache-Control", "no-store"));
      });
}

}  // namespace

void add_revisions_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/log/revisions",
      .handler = with(services, get_revisions),
      .summary = "What a centre hands on to its stations",
      .description =
          "Tables with own columns, keys of viewers and operators (by their hashes), setups, "
          "plans, catalogues, and corrections of the station's records that were made here: of "
          "each the last revision, in the order of their numbers. A station asks every few seconds "
          "with the position it was last answered; one that this service has not given out is "
          "answered with all there is.",
      .parameters = {{.name = "station",
                      .description =
                          "What the station's ids end with: whose corrections are meant"},
                     {.name = "after", .description = "The `position` of the last answer"}},
      .access = "station",
      .operation = "getRevisions",
      .tag = "log",
      .outcomes = {{.meaning = "What has changed", .schema = "Revisions"}},
      .refusals = {403},
  });
}

}  // namespace fitgauge::api

#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "base/json/json_writer.hpp"
#include "service/revisions/revision_feed.hpp"

namespace fitgauge::api {
namespace {

void write_custom_columns(JsonWriter& json, const std::vector<iso286::CustomColumn>& columns) {
  json.key("columns").begin_array();
  for (const iso286::CustomColumn& column : columns) {
    json.begin_object()
        .member("feature", word(column.feature))
        .member("tolerance_class", column.name)
        .key("rows")
        .begin_array();
    for (const auto& [range, deviations] : column.rows) {
      json.begin_object()
          .member_mm("over_mm", range.over)
          .member_mm("up_to_mm", range.up_to)
          .member_um("upper_um", deviations.upper)
          .member_um("lower_um", deviations.lower)
          .end_object();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

void write_revision(JsonWriter& json, const app::Revision& revision) {
  json.begin_object().member("number", revision.number).member("kind", word(revision.kind));
  if (!revision.name.empty()) json.member("name", revision.name);
  switch (revision.kind) {
    case app::RevisionKind::Tables:
      json.member("table_revision", revision.id);
      write_custom_columns(json, revision.columns);
      break;
    case app::RevisionKind::Key:
      if (revision.is_removed) break;
      json.member("role", word(revision.role)).member("token_sha256", to_hex(revision.token_hash));
      break;
    case app::RevisionKind::Correction:
      json.member("place", revision.place).member("record", revision.text);
      break;
    default:
      if (!revision.is_removed) json.member("text", revision.text);
  }
  if (revision.is_removed) json.member("removed", true);
  json.end_object();
}

std::string page_json(const app::RevisionPage& page) {
  std::string body;
  JsonWriter json(body);
  json.begin_object()
      .member("origin", page.origin)
      .member("size", page.size)
      .member("position", page.position)
      .member("more", page.more)
      .key("revisions")
      .begin_array();
  for (const app::Revision& revision : page.revisions) write_revision(json, revision);
  json.end_array().end_object();
  return body;
}

void get_revisions(const Services& services, const http::Request& request,
                   http::Responder responder) {
  services.revisions.read(
      request.text("station").value_or(""), std::string(request.text("after").value_or("")),
      [shared = share(std::move(responder))](const Result<app::RevisionPage>& page) {
        if (!page) return shared->fail(page.error());
        shared->answer(http::Response(200, "application/json", page_json(*page))
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

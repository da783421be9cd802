#include "api/handlers.hpp"
#include "api/resources.hpp"

#include <fmt/format.h>

#include "api/limits/limits_codec.hpp"
#include "api/tables/table_codec.hpp"
#include "api/wire/request_facts.hpp"
#include "base/json/json_value.hpp"
#include "service/tables/custom_column.hpp"
#include "tables/iso286/tolerance_class.hpp"
#include "tables/tabfile/iso286_projection.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::api {
namespace {

using iso286::Feature;
using iso286::ToleranceTables;

/// A strong tag names one form of one revision.
std::string form_etag(const ToleranceTables& tables, std::string_view form) {
  return '"' + tables.revision().id + '.' + std::string(form) + '"';
}

Result<http::Response> table_response(const http::Request& request, Feature feature,
                                      const ToleranceTables& tables) {
  const auto classes = chosen_classes(request.text("classes").value_or(""), feature, tables);
  if (!classes) return classes.error();
  const bool csv = wants_csv(request);
  http::Response response =
      csv ? http::Response(200, "text/csv; charset=utf-8; header=present",
                           table_csv(*classes, tables))
          : http::Response(200, "application/json", table_json(feature, *classes, tables));
  response.etag = form_etag(tables, csv ? "csv" : "json");
  response.with("Vary", "Accept");
  return response;
}

Result<http::Response> index_response(const http::Request&, const ToleranceTables& tables) {
  return tagged_json(table_index_json(tables), etag_of(tables));
}

Result<http::Response> tab_response(Feature feature, const ToleranceTables& tables) {
  http::Response response(200, "text/plain; charset=utf-8",
                          tabfile::write_tab(tabfile::project(tables, feature)));
  response.etag = form_etag(tables, "tab");
  return response;
}

/// The answer to a change: the new revision and its tag, with which the next change can be guarded.
void answer_change(const std::shared_ptr<http::Responder>& responder, int status,
                   const app::TableCatalog::ColumnStored& stored) {
  http::Response response(status);
  if (status != 204) {
    response = http::Response(status, "application/json", json_object([&](JsonWriter& json) {
                                json.member("revision", stored.revision);
                              }));
  }
  responder->answer(std::move(response).with("ETag", '"' + stored.revision + '"'));
}

/// The column that the path names. @errors PathMalformed when no column can be called so.
Result<std::string> column_name(const http::Request& request) {
  const std::string_view name = *request.text("name");
  if (iso286::is_class_name(name)) return std::string(name);
  return Error{
      ErrorCode::PathMalformed,
      fmt::format("the name must be a letter and up to 15 letters, digits or underscores; got '{}'",
                  name),
      "name"};
}

void put_column(const Services& services, Feature feature, const http::Request& request,
                http::Responder responder) {
  auto name = column_name(request);
  if (!name) return responder.fail(name.error());
  const auto parsed = parse_json(request.body());
  if (!parsed) return responder.fail(parsed.error());
  auto rows = decode_custom_rows(*parsed);
  if (!rows) return responder.fail(rows.error());
  const auto shared = share(std::move(responder));
  services.tables.put_column(
      {.feature = feature, .name = *std::move(name), .rows = *std::move(rows)},
      revisions_to_match(request), caller_text(request),
      [shared](Result<app::TableCatalog::ColumnStored> stored) {
        if (stored) return answer_change(shared, stored->created ? 201 : 200, *stored);
        Error error = std::move(stored).error();
        if (error.code == ErrorCode::TableRowsInvalid) {
          error = listed(ErrorCode::RequestInvalid, std::move(error.details));
        }
        shared->fail(std::move(error));
      });
}

void remove_column(const Services& services, Feature feature, const http::Request& request,
                   http::Responder responder) {
  auto name = column_name(request);
  if (!name) return responder.fail(name.error());
  const auto shared = share(std::move(responder));
  services.tables.remove_column(feature, *std::move(name), revisions_to_match(request),
                                caller_text(request),
                                [shared](Result<app::TableCatalog::ColumnStored> stored) {
                                  if (!stored) return shared->fail(stored.error());
                                  answer_change(shared, 204, *stored);
                                });
}

http::AsyncHandler with(const Services& services, Feature feature,
                        void (*handler)(const Services&, Feature, const http::Request&,
                                        http::Responder)) {
  return [&services, feature, handler](const http::Request& request, http::Responder responder) {
    handler(services, feature, request, std::move(responder));
  };
}

void add_feature_routes(std::vector<http::Route>& routes, const Services& services,
                        const std::shared_ptr<ResponseCache>& cache, Feature feature) {
  const std::string path = "/v1/tables/" + std::string(word(feature));
  const std::string table = feature == Feature::Hole ? "HoleTable" : "ShaftTable";
  routes.push_back({
      .pattern = path,
      .handler = ResponseCache::of_revision(
          cache,
          [feature](const http::Request& request, const ToleranceTables& tables) {
            return table_response(request, feature, tables);
          }),
      .summary = "Limit deviations of every class and size range",
      .parameters = {{.name = "classes", .description = "H7,JS7: only these classes"},
                     csv_or_json(),
                     revision_parameter()},
      .response_types = {"application/json", "text/csv"},
      .access = "open",
      .operation = "get" + table,
      .outcomes = {{.meaning = "The table", .schema = "Table"}},
      .refusals = {404},
  });
  routes.push_back({
      .pattern = path + ".tab",
      .handler =
          ResponseCache::cached(cache,
                                [feature](const http::Request&, const ToleranceTables& tables) {
                                  return tab_response(feature, tables);
                                }),
      .summary = "The table as the control's freely definable table, as program 8255 reads it",
      .response_types = {"text/plain"},
      .access = "open",
      .operation = "get" + table + "Tab",
      .outcomes = {{.meaning = "The file"}},
  });
  const http::Parameter name =
      path_parameter("name", "Letter, then letters, digits and _; at most 16");
  const http::Parameter if_match{.name = "If-Match",
                                 .place = http::ParameterPlace::Header,
                                 .description = "Tag of the tables the change follows"};
  routes.push_back({
      .method = http::Method::Put,
      .pattern = path + "/classes/{name}",
      .handler = with(services, feature, put_column),
      .summary = "Store a custom tolerance class as a new revision",
      .parameters = {name, if_match},
      .body = json_body("Column"),
      .access = "admin",
      .operation = "put" + table + "Column",
      .outcomes = {{.meaning = "The column is replaced", .schema = "Revision"},
                   {.status = 201, .meaning = "The column is new", .schema = "Revision"}},
      .refusals = {404, 412},
  });
  routes.push_back({
      .method = http::Method::Delete,
      .pattern = path + "/classes/{name}",
      .handler = with(services, feature, remove_column),
      .summary = "Back to the standard",
      .parameters = {name, if_match},
      .access = "admin",
      .operation = "delete" + table + "Column",
      .outcomes = {{.status = 204, .meaning = "It is gone"}},
      .refusals = {404, 412},
  });
}

}  // namespace

void add_tables_routes(std::vector<http::Route>& routes, const Services& services,
                       const std::shared_ptr<ResponseCache>& cache) {
  routes.push_back({
      .pattern = "/v1/tables",
      .handler = ResponseCache::cached(cache, index_response),
      .summary = "The tables in use and their classes",
      .access = "open",
      .operation = "listTables",
      .outcomes = {{.meaning = "The tables", .schema = "TableIndex"}},
  });
  for (const Feature feature : {Feature::Hole, Feature::Shaft}) {
    add_feature_routes(routes, services, cache, feature);
  }
}

}  // namespace fitgauge::api

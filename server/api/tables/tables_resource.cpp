#include "api/limits/limits_codec.hpp"
#include "api/resources.hpp"
#include "api/wire/request_facts.hpp"
#include "http/field_list.hpp"
#include "service/tables/custom_column.hpp"
#include "tables/tabfile/iso286_projection.hpp"

namespace fitgauge::api {
namespace {

using iso286::ClassId;
using iso286::Feature;
using iso286::LimitDeviations;
using iso286::NominalSizeRange;
using iso286::ToleranceTables;

void append_class_cells(std::string& out, const std::optional<LimitDeviations>& deviations) {
  out += ',';
  if (deviations) append_um(out, deviations->upper);
  out += ',';
  if (deviations) append_um(out, deviations->lower);
}

/// The classes named by `H7,JS7`; all of the feature when the text is empty.
/// @errors ClassUnknown, also for a class of the other feature; QueryInvalid for an empty name.
Result<std::vector<ClassId>> chosen_classes(std::string_view names, Feature feature,
                                            const ToleranceTables& tables) {
  if (names.empty()) {
    const auto all = tables.classes(feature);
    return std::vector<ClassId>(all.begin(), all.end());
  }
  std::vector<ClassId> chosen;
  for (const std::string_view name : split(names, ',')) {
    const auto id = tables.find_class(name);
    if (!id) return Error{ErrorCode::ClassUnknown, id.error().message};
    if (tables.feature(*id) != feature) {
      return Error::of(ErrorCode::ClassUnknown, "{} is not a class of the {} table", name,
                       word(feature));
    }
    if (std::ranges::find(chosen, *id) == chosen.end()) chosen.push_back(*id);
  }
  return chosen;
}

/// One feature's table as JSON: a row a size range, an undefined class is absent.
std::string table_json(Feature feature, const std::vector<ClassId>& classes,
                       const ToleranceTables& tables) {
  return json_object([&](JsonWriter& json) {
    json.member("revision", tables.revision().id).member("feature", word(feature));
    json.key("rows").begin_array();
    for (const NominalSizeRange& range : tables.ranges()) {
      json.begin_object().member_mm("over_mm", range.over).member_mm("up_to_mm", range.up_to);
      json.key("limits").begin_object();
      for (const ClassId id : classes) {
        const auto deviations = deviations_in_range(tables, id, range);
        if (!deviations) continue;
        json.key(tables.class_name(id)).begin_object();
        json.member_um("upper_um", deviations->upper).member_um("lower_um", deviations->lower);
        json.end_object();
      }
      json.end_object().end_object();
    }
    json.end_array();
  });
}

/// Writes the table as CSV with two columns for each class; an undefined class is blank.
std::string table_csv(const std::vector<ClassId>& classes, const ToleranceTables& tables) {
  std::string out = "over_mm,up_to_mm";
  for (const ClassId id : classes)
    out += fmt::format(",{0}_upper_um,{0}_lower_um", tables.class_name(id));
  out += "\r\n";
  for (const NominalSizeRange& range : tables.ranges()) {
    append_mm(out, range.over);
    out += ',';
    append_mm(out, range.up_to);
    for (const ClassId id : classes)
      append_class_cells(out, deviations_in_range(tables, id, range));
    out += "\r\n";
  }
  return out;
}

std::string table_index_json(const ToleranceTables& tables) {
  return json_object([&](JsonWriter& json) {
    json.member("revision", tables.revision().id);
    json.list("tables", std::array{Feature::Hole, Feature::Shaft}, [&](Feature feature) {
      const auto name_of = [&](ClassId id) { return tables.class_name(id); };
      const auto& classes = tables.classes(feature);
      json.begin_object().member("feature", word(feature)).list("classes", classes, name_of);
      json.list("own", classes, [&](ClassId id) {
        if (tables.basis(id) == iso286::Basis::Custom) json.value(tables.class_name(id));
      });
      json.member("size_ranges", std::uint64_t{tables.ranges().size()}).end_object();
    });
  });
}

/// A strong tag names one form of one revision by one release.
std::string form_etag(const ToleranceTables& tables, std::string_view form) {
  return fmt::format("\"{}.{}.{}\"", tables.revision().id, form, kVersion);
}

Result<Response> table_response(const Request& request, Feature feature,
                                const ToleranceTables& tables) {
  const auto classes = TRY(chosen_classes(request.text("classes").value_or(""), feature, tables));
  const bool csv = wants_csv(request);
  Response response =
      csv ? Response(200, "text/csv; charset=utf-8; header=present", table_csv(classes, tables))
          : Response(200, "application/json", table_json(feature, classes, tables));
  response.etag = form_etag(tables, csv ? "csv" : "json");
  response.with("Vary", "Accept");
  return response;
}

Result<Response> index_response(const Request&, const ToleranceTables& tables) {
  return tagged_json(table_index_json(tables), etag_of(tables));
}

Result<Response> tab_response(Feature feature, const ToleranceTables& tables) {
  Response response(200, "text/plain; charset=utf-8",
                    tabfile::write_tab(tabfile::project(tables, feature)));
  response.etag = form_etag(tables, "tab");
  return response;
}

/// The answer to a change: the new revision and its tag, with which the next change can be guarded.
void answer_change(const std::shared_ptr<Responder>& responder, int status,
                   const app::TableCatalog::ColumnStored& stored) {
  Response response(status);
  if (status != 204) {
    response =
        Response(status, "application/json",
                 json_object([&](JsonWriter& json) { json.member("revision", stored.revision); }));
  }
  responder->answer(std::move(response).with("ETag", '"' + stored.revision + '"'));
}

/// The column that the path names. @errors PathMalformed when no column can be called so.
Result<std::string> column_name(const Request& request) {
  const std::string_view name = *request.text("name");
  if (iso286::is_class_name(name)) return std::string(name);
  return Error{
      ErrorCode::PathMalformed,
      fmt::format("the name must be a letter and up to 15 letters, digits or underscores; got '{}'",
                  name),
      "name"};
}

/// Whether entity tags match the tables of a revision, in any form, or `*` a class that exists.
bool name_tables(std::string_view tags, std::string_view revision, bool exists, bool weakly) {
  if (trim(tags) == "*") return exists;
  const auto items = http::list_items(tags);
  return std::ranges::any_of(items, [&](std::string_view tag) {
    if (weakly && tag.starts_with("W/")) tag.remove_prefix(2);
    if (!tag.starts_with('"') || !tag.substr(1).starts_with(revision)) return false;
    const std::string_view form = tag.substr(1 + revision.size());
    return form == "\"" || form == "-gzip\"" || (form.starts_with('.') && form.ends_with('"'));
  });
}

app::TableCatalog::Condition condition_of(const Request& request) {
  return [asked = preconditions_of(request)](std::string_view revision, bool exists) {
    return (!asked.if_match || name_tables(*asked.if_match, revision, exists, false)) &&
           !(exists && asked.if_none_match &&
             name_tables(*asked.if_none_match, revision, exists, true));
  };
}

void put_column(const Services& services, Feature feature, const Request& request,
                Responder responder) {
  auto name = TRY_OR_FAIL(responder, column_name(request));
  const auto parsed = TRY_OR_FAIL(responder, parse_json(request.body()));
  auto column = TRY_OR_FAIL(responder, read_whole<CustomRows>(parsed));
  const auto shared = share(std::move(responder));
  services.tables.put_column(
      {.feature = feature, .name = std::move(name), .rows = std::move(column.rows)},
      condition_of(request), caller_text(request),
      [shared](Result<app::TableCatalog::ColumnStored> stored) {
        if (stored) return answer_change(shared, stored->created ? 201 : 200, *stored);
        Error error = std::move(stored).error();
        if (error.code == ErrorCode::TableRowsInvalid)
          error = listed(ErrorCode::RequestInvalid, std::move(error.details));
        shared->fail(std::move(error));
      });
}

void remove_column(const Services& services, Feature feature, const Request& request,
                   Responder responder) {
  auto name = TRY_OR_FAIL(responder, column_name(request));
  const auto shared = share(std::move(responder));
  services.tables.remove_column(feature, std::move(name), condition_of(request),
                                caller_text(request),
                                [shared](Result<app::TableCatalog::ColumnStored> stored) {
                                  if (!stored) return shared->fail(stored.error());
                                  answer_change(shared, 204, *stored);
                                });
}

http::AsyncHandler with(const Services& services, Feature feature,
                        void (*handler)(const Services&, Feature, const Request&, Responder)) {
  return [&services, feature, handler](const Request& request, Responder responder) {
    handler(services, feature, request, std::move(responder));
  };
}

void add_feature_routes(Routes& add, Feature feature) {
  const std::string path = "/v1/tables/" + std::string(word(feature));
  const std::string table = feature == Feature::Hole ? "HoleTable" : "ShaftTable";
  add("GET " + path + " get" + table + " open 404",
      ResponseCache::of_revision(add.cache,
                                 [feature](const Request& request, const ToleranceTables& tables) {
                                   return table_response(request, feature, tables);
                                 }),
      {.summary = "Limit deviations of every class and size range",
       .parameters = {query("classes", "H7,JS7: only these classes"), csv_or_json(),
                      revision_parameter()},
       .response_types = {"application/json", "text/csv"},
       .outcomes = {{.meaning = "The table", .schema = "Table"}}});
  add("GET " + path + ".tab get" + table + "Tab open",
      ResponseCache::cached(add.cache,
                            [feature](const Request&, const ToleranceTables& tables) {
                              return tab_response(feature, tables);
                            }),
      {.summary = "The table as the control's freely definable table, as program 8255 reads it",
       .response_types = {"text/plain"},
       .outcomes = {{.meaning = "The file"}}});
  const Parameter name = path_parameter("name", "Letter, then letters, digits and _; at most 16");
  add("PUT " + path + "/classes/{name} put" + table + "Column admin 404 412",
      with(add.services, feature, put_column),
      {.summary = "Store a custom tolerance class as a new revision",
       .parameters = with_preconditions(name),
       .body = json_body("Column"),
       .outcomes = {{.meaning = "Custom class replaced", .schema = "Revision"},
                    {.status = 201, .meaning = "Custom class created", .schema = "Revision"}}});
  add("DELETE " + path + "/classes/{name} delete" + table + "Column admin 404 409 412",
      with(add.services, feature, remove_column),
      {.summary = "Delete a custom class; the standard class counts again",
       .parameters = with_preconditions(name),
       .outcomes = {{.status = 204, .meaning = "Deleted"}}});
}

}  // namespace

void add_table_schemas(Schemas& schemas) {
  const std::string range = schema::object({
      {"feature", feature_words(), ""},
      {"classes", schema::array(schema::text()), "Classes of the standard, then custom ones"},
      {"own", schema::array(schema::text()), "Custom tolerance classes"},
      {"size_ranges", schema::count(), ""},
  });
  schemas.push_back(
      {"TableIndex", schema::object({{"revision", schema::text(), "Revision of all tables"},
                                     {"tables", schema::array(range), ""}})});
  const std::string deviations =
      schema::object({{"upper_um", schema::number(), ""}, {"lower_um", schema::number(), ""}});
  const std::string row = schema::object({
      {"over_mm", schema::number(), "Exclusive"},
      {"up_to_mm", schema::number(), "Inclusive"},
      {"limits", schema::map(deviations),
       "Limits by class; a class that is undefined for the range is absent"},
  });
  schemas.push_back({"Table", schema::object({{"revision", schema::text(), ""},
                                              {"feature", feature_words(), ""},
                                              {"rows", schema::array(row), "Sorted by size"}})});
  schemas.push_back(order_schema<CustomRows>("Column"));
  schemas.push_back({"Revision", schema::object({{"revision", schema::text(),
                                                  "Revision of the tables from now on"}})});
}

void add_tables_routes(Routes& add) {
  add("GET /v1/tables listTables open", ResponseCache::cached(add.cache, index_response),
      {.summary = "The tables in use and their classes",
       .outcomes = {{.meaning = "The tables", .schema = "TableIndex"}}});
  for (const Feature feature : {Feature::Hole, Feature::Shaft}) add_feature_routes(add, feature);
}

}  // namespace fitgauge::api

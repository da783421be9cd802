#include "api/resources.hpp"

#include "api/limits/limits_codec.hpp"

namespace fitgauge::api {
namespace {

using standards::Cell;
using standards::Member;
using standards::Row;
using standards::Standard;

void write_identity(JsonWriter& json, const Standard& standard) {
  json.member("name", standard.name)
      .member("edition", standard.edition)
      .member("title", standard.title)
      .member("revision", std::string_view(standard.revision));
  if (!standard.designation.empty()) json.member("designation", standard.designation);
  if (!standard.left_out.empty()) json.member("left_out", standard.left_out);
}

Result<Response> list(const Request& /*request*/, const iso286::ToleranceTables& /*tables*/) {
  std::string body;
  std::string etag = "\"";
  JsonWriter json(body);
  json.begin_object().key("standards").begin_array();
  for (const Standard& standard : standards::all()) {
    json.begin_object();
    write_identity(json, standard);
    json.list("tables", standard.tables, &standards::Table::name);
    json.list("sources", standard.sources).end_object();
    etag += standard.revision.substr(standard.revision.size() - 8);
  }
  json.end_array().end_object();
  return tagged_json(std::move(body), etag + '"');
}

void write_cell(JsonWriter& json, const Cell& cell) {
  const Length length = Length::nanometres(cell.count);
  switch (cell.member) {
    case Member::Nominal: json.member_mm("nominal_mm", length); break;
    case Member::Upper: json.member_um("upper_um", length); break;
    case Member::Lower: json.member_um("lower_um", length); break;
    case Member::Tolerance: json.member_um("tolerance_um", length); break;
    case Member::Deviation: json.member_um("deviation_um", length); break;
    case Member::UpperAngle: json.member("upper_arcmin", cell.count); break;
    case Member::LowerAngle: json.member("lower_arcmin", cell.count); break;
  }
}

/// The width of a keyway in the classes of its fits: tight, light, sliding (DIN 6885-1, table 1).
void write_widths(JsonWriter& json, Length width, const iso286::ToleranceTables& tables) {
  const auto size = iso286::NominalSize::make(width);
  for (const std::string_view name : {"P9", "N9", "JS9", "H8", "D10"}) {
    const auto limits = tables.limits_of_size(*size, name);
    if (!limits) continue;
    json.key(fmt::format("width_{}", name))
        .begin_object()
        .member("designation", designation_text(width, name))
        .member_mm("nominal_mm", width)
        .member_um("upper_um", limits->deviations.upper)
        .member_um("lower_um", limits->deviations.lower)
        .end_object();
  }
}

void write_row(JsonWriter& json, std::string_view table, const Row& row,
               const iso286::ToleranceTables& tables) {
  json.begin_object().member("table", table);
  const auto key = [&json](std::string_view name, const std::optional<Length>& value) {
    if (value) json.member_mm(name, *value);
  };
  key("over_mm", row.over);
  key("up_to_mm", row.up_to);
  key("pitch_mm", row.pitch);
  key("diameter_mm", row.diameter);
  json.key("limits").begin_object();
  std::string_view item;
  for (const Cell& cell : row.cells) {
    if (cell.item != item) {
      if (!item.empty()) json.end_object();
      item = cell.item;
      json.key(item).begin_object();
    }
    write_cell(json, cell);
  }
  if (!item.empty()) json.end_object();
  if (table == "keyways") write_widths(json, *row.length("width", Member::Nominal), tables);
  json.end_object().end_object();
}

Result<Response> rows(const Request& request, const iso286::ToleranceTables& tables) {
  const std::string_view name = *request.text("name");
  const Standard* standard = standards::find(name);
  if (standard == nullptr) {
    std::string known;
    for (const Standard& other : standards::all())
      known += fmt::format("{}{}", known.empty() ? "" : ", ", other.name);
    return Error::of(ErrorCode::NotFound, "unknown standard '{}'; known standards: {}",
                     first_characters(name, 40), known);
  }
  const auto size = request.length("size_mm");
  const auto only = request.text("table");
  std::string body;
  JsonWriter json(body);
  json.begin_object();
  write_identity(json, *standard);
  json.key("rows").begin_array();
  bool has_table = false;
  for (const standards::Table& table : standard->tables) {
    if (only && *only != table.name) continue;
    has_table = true;
    for (const Row& row : table.rows) {
      if (!size || row.holds(*size)) write_row(json, table.name, row, tables);
    }
  }
  json.end_array().end_object();
  if (!has_table) {
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("unknown table of {}: '{}'; GET /v1/standards lists them", name,
                             first_characters(*only, 40)),
                 "table"};
  }
  // Custom tolerance classes may replace the widths of a keyway.
  const std::string own = etag_of(tables);
  return tagged_json(std::move(body),
                     etag_of(*standard).insert(1, own.substr(1, own.size() - 2) + '.'));
}

}  // namespace

void add_standards_routes(Routes& add) {
  add("GET /v1/standards listStandards open", ResponseCache::cached(add.cache, list),
      {.summary = "The standards other than ISO 286 that the service has tables of",
       .description = "Their editions, tables and what the numbers were compared with.",
       .outcomes = {{.meaning = "The standards", .schema = "Standards"}}});
  add("GET /v1/standards/{name} getStandard open 404", ResponseCache::cached(add.cache, rows),
      {.summary = "The numbers of a standard: general tolerances, threads, keyways, bearings",
       .description = "Deviations in µm, nominal sizes in mm, angles in minutes; what the standard "
                      "has no number for is absent.",
       .parameters = {path_parameter("name", "iso2768-1, iso965-1, din6885-1 or iso492"),
                      query("size_mm", http::LengthIn{},
                            "Only rows that hold for this size: of a keyway the diameter of "
                            "its shaft"),
                      query("table", "Only this table")},
       .outcomes = {{.meaning = "Rows of the table", .schema = "Standard"}}});
}

}  // namespace fitgauge::api

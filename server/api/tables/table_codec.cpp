#include "api/tables/table_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "api/resources.hpp"
#include "base/json/json_writer.hpp"
#include "tables/iso286/limit_deviations.hpp"

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

}  // namespace

Result<std::vector<ClassId>> chosen_classes(std::string_view names, Feature feature,
                                            const ToleranceTables& tables) {
  if (names.empty()) {
    const auto all = tables.classes(feature);
    return std::vector<ClassId>(all.begin(), all.end());
  }
  std::vector<ClassId> chosen;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t comma = std::min(names.find(',', begin), names.size());
    const std::string_view name = names.substr(begin, comma - begin);
    begin = comma + 1;
    const auto id = tables.find_class(name);
    if (!id) return Error{ErrorCode::ClassUnknown, id.error().message};
    if (tables.feature(*id) != feature) {
      return Error{ErrorCode::ClassUnknown,
                   fmt::format("{} is not a class of the {} table", name, word(feature))};
    }
    if (std::find(chosen.begin(), chosen.end(), *id) == chosen.end()) chosen.push_back(*id);
  }
  return chosen;
}

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

std::string table_csv(const std::vector<ClassId>& classes, const ToleranceTables& tables) {
  std::string out = "over_mm,up_to_mm";
  for (const ClassId id : classes) {
    out += fmt::format(",{0}_upper_um,{0}_lower_um", tables.class_name(id));
  }
  out += "\r\n";
  for (const NominalSizeRange& range : tables.ranges()) {
    append_mm(out, range.over);
    out += ',';
    append_mm(out, range.up_to);
    for (const ClassId id : classes) {
      append_class_cells(out, deviations_in_range(tables, id, range));
    }
    out += "\r\n";
  }
  return out;
}

std::string table_index_json(const ToleranceTables& tables) {
  return json_object([&](JsonWriter& json) {
    json.member("revision", tables.revision().id).key("tables").begin_array();
    for (const Feature feature : {Feature::Hole, Feature::Shaft}) {
      json.begin_object().member("feature", word(feature)).key("classes").begin_array();
      for (const ClassId id : tables.classes(feature)) json.value(tables.class_name(id));
      json.end_array().key("own").begin_array();
      for (const ClassId id : tables.classes(feature)) {
        if (tables.basis(id) == iso286::Basis::Custom) json.value(tables.class_name(id));
      }
      json.end_array().member("size_ranges", std::uint64_t{tables.ranges().size()}).end_object();
    }
    json.end_array();
  });
}

using schema::Others;

void add_table_schemas(Schemas& schemas) {
  const std::string range = schema::object({
      {"feature", feature_words(), ""},
      {"classes", schema::array(schema::text()), "Of the standard, then the custom ones"},
      {"own", schema::array(schema::text()), "Custom tolerance classes"},
      {"size_ranges", schema::count(), ""},
  });
  schemas.push_back({"TableIndex", schema::object({{"revision", schema::text(), "Of all tables"},
                                                   {"tables", schema::array(range), ""}})});
  const std::string deviations =
      schema::object({{"upper_um", schema::number(), ""}, {"lower_um", schema::number(), ""}});
  const std::string row = schema::object({
      {"over_mm", schema::number(), "Exclusive"},
      {"up_to_mm", schema::number(), "Inclusive"},
      {"limits", schema::map(deviations),
       "By class; one that is undefined for the range is absent"},
  });
  schemas.push_back(
      {"Table",
       schema::object({{"revision", schema::text(), ""},
                       {"feature", feature_words(), ""},
                       {"rows", schema::array(row), "By size"}},
                      Others::Allowed,
                      R"({"revision":"1-f0a85b3a","feature":"hole","rows":[{"over_mm":18,)"
                      R"("up_to_mm":30,"limits":{"H7":{"upper_um":21,"lower_um":0}}}]})")});
  const std::string custom_row = schema::object(
      {
          {"over_mm", schema::exact(), "Exclusive; the upper end of the row before"},
          {"up_to_mm", schema::exact(), "Inclusive"},
          {"upper_um", schema::exact(), "Upper deviation"},
          {"lower_um", schema::exact(), "Lower deviation"},
      },
      Others::Refused);
  schemas.push_back(
      {"Column",
       schema::object({{"rows", schema::array(custom_row), "At least one, contiguous, by size"}},
                      Others::Refused,
                      R"({"rows":[{"over_mm":18,"up_to_mm":30,"upper_um":15,"lower_um":-3}]})")});
  schemas.push_back(
      {"Revision", schema::object({{"revision", schema::text(), "Of the tables from now on"}},
                                  Others::Allowed, R"({"revision":"2-1c0ffee2"})")});
}

}  // namespace fitgauge::api

#include "service/tables/custom_column.hpp"

#include "base/json/field_reader.hpp"

namespace fitgauge::api {

void write_custom_rows(JsonWriter& json, const std::vector<iso286::CustomRow>& rows) {
  json.begin_array();
  for (const auto& [range, deviations] : rows) {
    json.begin_object()
        .member_mm("over_mm", range.over)
        .member_mm("up_to_mm", range.up_to)
        .member_um("upper_um", deviations.upper)
        .member_um("lower_um", deviations.lower)
        .end_object();
  }
  json.end_array();
}

Result<std::vector<iso286::CustomRow>> decode_custom_rows(const JsonValue& body) {
  FieldErrors errors;
  std::vector<iso286::CustomRow> rows;
  FieldReader fields(body, "", errors);
  if (const JsonValue* list = fields.array("rows")) {
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      FieldReader row(list->items[i], pointer_to("/rows", i), errors);
      const auto over = row.mm("over_mm");
      const auto up_to = row.mm("up_to_mm");
      const auto upper = row.um("upper_um");
      const auto lower = row.um("lower_um");
      row.refuse_unknown();
      if (over && up_to && upper && lower) {
        rows.push_back({.range = {.over = *over, .up_to = *up_to},
                        .deviations = {.upper = *upper, .lower = *lower}});
      }
    }
    if (list->items.empty()) {
      errors.add(ErrorCode::FieldInvalid, "/rows", "a column needs at least one row");
    }
  }
  fields.refuse_unknown();
  if (auto error = errors.take()) return std::move(*error);
  return rows;
}

}  // namespace fitgauge::api

#pragma once

#include <concepts>

#include "base/json/body_forms.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// The rows of a custom column as they are sent and stored.
struct CustomRows {
  std::vector<iso286::CustomRow> rows{};
};

template <class Row>
requires std::same_as<std::remove_const_t<Row>, iso286::CustomRow>
void members(auto& v, Row& row) {
  v.member("over_mm", row.range.over, Millimetres{}, "Exclusive; the upper end of the row before");
  v.member("up_to_mm", row.range.up_to, Millimetres{}, "Inclusive");
  v.member("upper_um", row.deviations.upper, Micrometres{}, "Upper deviation");
  v.member("lower_um", row.deviations.lower, Micrometres{}, "Lower deviation");
}

template <class Column>
requires std::same_as<std::remove_const_t<Column>, CustomRows>
void members(auto& v, Column& column) {
  v.member("rows", column.rows, "At least one, contiguous, by size");
  v.check([&column](FieldReader& fields) {
    if (!column.rows.empty() || fields.errors().has(fields.at("rows"))) return;
    fields.report(ErrorCode::FieldInvalid, "rows",
                  "a custom tolerance class needs at least one row");
  });
}

}  // namespace fitgauge::api

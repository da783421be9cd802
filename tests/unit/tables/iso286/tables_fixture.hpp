#pragma once

#include "tables/iso286/tolerance_class.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::iso286 {

/// The tables of the standard alone.
inline const ToleranceTables& standard_tables() {
  static const ToleranceTables kTables =
      ToleranceTables::make(compiled_in_tables(), {"iso"}).value();
  return kTables;
}

/// With columns of a shop.
inline ToleranceTables tables_with(std::vector<CustomColumn> columns) {
  TableData data = compiled_in_tables();
  data.custom_columns = std::move(columns);
  return ToleranceTables::make(data, {"shop"}).value();
}

inline NominalSize size_mm(std::string_view text) { return NominalSize::parse_mm(text).value(); }

/// `+21/0` in µm, or the id of the error.
inline std::string deviations(const ToleranceTables& tables, std::string_view designation) {
  const auto parsed = parse_designation(designation);
  if (!parsed) return std::string(id(parsed.error().code));
  const auto limits = tables.limits_of_size(parsed->nominal_size, parsed->class_name);
  if (!limits) return std::string(id(limits.error().code));
  const auto signed_um = [](Length length) {
    return (length > Length() ? "+" : "") + format_um(length);
  };
  return signed_um(limits->deviations.upper) + "/" + signed_um(limits->deviations.lower);
}

inline std::string deviations(std::string_view designation) {
  return deviations(standard_tables(), designation);
}

}  // namespace fitgauge::iso286

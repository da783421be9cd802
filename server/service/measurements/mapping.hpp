#pragma once

#include "db/store/tables_store.hpp"
#include "service/measurements/measurement_service.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {

/// Table content between the field's types and the store's plain integers.
store::TableContent to_store(const iso286::TableData& data);
/// @errors TablesInconsistent for a table or column the standard does not know.
Result<iso286::TableData> from_store(const store::TableContent& content);

/// @pre a measurement with a table revision also has the number of this revision
MeasurementRow to_store(const Measurement& measurement);

/// Outside names of the numbers in a row; valid as long as the catalog and the origins.
struct RowNames {
  std::function<std::string_view(std::int64_t number)> revision_id;
  /// The digits of the id that this number of an origin has.
  std::function<std::string_view(std::int64_t origin, std::int64_t number)> origin;
};
RowNames row_names(const TableCatalog& tables, const Origins& origins);
Measurement from_store(const MeasurementRow& row, const RowNames& names);

store::IdempotentRequest to_store(const IdempotencyScope& scope);

}  // namespace fitgauge::app

#include "app/measurements/measurement_storage.hpp"

#include <algorithm>

#include "app/measurements/mapping.hpp"
#include "app/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

bool is_by_tables(const Measurement& m) { return m.basis != LimitsBasis::Explicit; }

}  // namespace

std::optional<std::int64_t> revision_of(std::span<const Measurement> measurements,
                                        const TableCatalog& tables) {
  const auto judged = std::find_if(measurements.begin(), measurements.end(), is_by_tables);
  if (judged == measurements.end()) return std::nullopt;
  return tables.revision_number(judged->table_revision);
}

void append_rows(std::vector<store::MeasurementRow>& rows,
                 std::span<const Measurement> measurements, std::optional<std::int64_t> revision) {
  for (const Measurement& m : measurements) {
    rows.push_back(to_store(m, is_by_tables(m) ? revision : std::nullopt));
  }
}

std::int64_t number_from(std::int64_t first, std::span<Measurement> measurements) {
  for (Measurement& measurement : measurements) measurement.id = first++;
  return first;
}

Error too_much_work() {
  return {ErrorCode::StorageBusy, "the storage has all the work it takes; try again soon"};
}

}  // namespace fitgauge::app

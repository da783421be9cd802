#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store::sql {

/// The end of the measurements, where an engine adds rows its own way.
class MeasurementTable {
 public:
  MeasurementTable() = default;
  MeasurementTable(const MeasurementTable&) = delete;
  MeasurementTable& operator=(const MeasurementTable&) = delete;
  virtual ~MeasurementTable() = default;

  /// @param rows numbered on from the last.
  virtual void append(std::span<const MeasurementRow> rows) = 0;
  /// 0 when there is none.
  virtual std::int64_t last_id() = 0;
  /// How many rows of this folder's own there are, where the engine counts them and numbers them in
  /// their log; else none.
  virtual std::optional<std::int64_t> own_rows() { return std::nullopt; }
};

}  // namespace fitgauge::store::sql

#pragma once

#include <cstdint>
#include <span>

#include "store/measurement_row.hpp"

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
};

}  // namespace fitgauge::store::sql

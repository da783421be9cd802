#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// Judges one measurement; says what is wrong with it (`was altered …`), or nothing.
using MeasurementCheck = std::function<std::optional<std::string>(const MeasurementRow& row)>;

struct VerifyReport {
  std::int64_t measurements = 0;  ///< rows whose hash and check were computed
  /// One sentence each, the first altered measurement by its id; empty when all is well. After 100
  /// findings the rest is left out.
  std::vector<std::string> findings{};
};

}  // namespace fitgauge::store

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// Counts and statistics of one group, from exact integer sums.
struct SummaryGroup {
  std::optional<std::string> value{};  ///< none: the rows without the field
  std::int64_t count = 0;
  std::array<std::int64_t, 5> verdicts{};              ///< by Verdict, Good first
  std::string mean_mm{};                               ///< to 1e-12 mm, shortest decimal
  std::optional<std::string> standard_deviation_mm{};  ///< of n - 1; none for a single value
  std::int64_t min_nm = 0;
  std::int64_t max_nm = 0;

  std::int64_t verdict_count(Verdict verdict) const {
    return verdicts[static_cast<std::size_t>(verdict) - 1];
  }
};

}  // namespace fitgauge::store

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace fitgauge::store {

/// What figures are computed from: a measured value, its limits and what it is grouped by.
struct MeasuredValue {
  std::int64_t measured_nm = 0;  ///< at 20 °C where it was corrected
  std::int64_t lower_limit_nm = 0;
  std::int64_t upper_limit_nm = 0;
  std::optional<std::string_view> subgroup{};  ///< the database's own while a visitor runs
};

/// Values of one folder, in storage order, that share their limits and their subgroup.
struct MeasuredRun {
  struct Value {
    std::int64_t id = 0;
    std::int64_t number = 0;  ///< in its public id
    std::int64_t measured_nm = 0;
  };

  std::int64_t lower_limit_nm = 0;
  std::int64_t upper_limit_nm = 0;
  std::optional<std::string_view> subgroup{};
  std::int64_t origin = 0;  ///< 0: of this folder
  std::span<const Value> values{};
};

}  // namespace fitgauge::store

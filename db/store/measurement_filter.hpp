#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "store/measurement_row.hpp"

namespace fitgauge::store {

/// Which measurements a list or a summary shows. A text filter matches the whole text exactly.
struct MeasurementFilter {
  std::optional<std::string> part_id{};
  std::optional<std::string> characteristic{};
  std::optional<std::string> order{};
  std::optional<std::string> machine{};
  std::optional<Verdict> verdict{};
  std::optional<Source> source = Source::Gauge;  ///< none: all
  std::optional<std::int64_t> from_ns{};         ///< from <= measured_at
  std::optional<std::int64_t> to_ns{};           ///< measured_at < to
  bool history = false;                          ///< also rows that a later one corrects
  /// The state when this was the newest id, so that a list read in pages is of one piece.
  std::optional<std::int64_t> as_of_id{};
};

}  // namespace fitgauge::store

#pragma once

#include "service/measurements/gauges_in_use.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// The next offset of some values, for readers of events.
struct OffsetNews {
  std::string_view event{};  ///< kOffsetChanged or kOffsetFailed
  std::string data{};        ///< JSON: the proposal, or the reason for none
  std::string told{};        ///< text that changes only with news: the state, or the failure
  std::string newest{};      ///< id of the newest value; empty: there is none
};
inline constexpr std::string_view kOffsetChanged = "compensation.changed";
inline constexpr std::string_view kOffsetFailed = "compensation.failed";

/// Selects the values from which the next offset is computed.
struct OffsetOrder {
  app::MeasurementQuery query{};   ///< newest_first
  std::optional<Length> target{};  ///< none: the middle of the limits
  double cost = 0.1;               ///< of a correction, in parts

  /// @param done called on a storage thread. @errors those of storage.
  void find_news(app::MeasurementService& measurements, const GaugesInUse& gauges,
                 std::function<void(Result<OffsetNews>)> done) const;
};

}  // namespace fitgauge::api

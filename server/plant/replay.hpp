#pragma once

#include <string>

#include "base/json/body_forms.hpp"
#include "plant/plant.hpp"
#include "plant/progress.hpp"

namespace fitgauge::connections {

/// Where an outgoing connection sends again from: `{"from": …}`.
struct ReplayOrder {
  std::string from{};
};

template <class V>
void members(V& v, ReplayOrder& order) {
  v.member("from", order.from, api::Text{64},
           "The id of a measurement or of an event (e17-…), or an RFC 3339 time");
}

/// Moves the progress back to the place, which goes out again with all that follows: from the id of
/// a measurement the measurements, from that of an event the events, from a time both. Waits.
/// @errors RequestInvalid naming `/from`, also for a place that has not gone out yet; those of
///   storage.
Result<void> move_back(Progress& progress, const ReplayOrder& order, const Plant& plant);

}  // namespace fitgauge::connections

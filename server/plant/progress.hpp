#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/json/body_forms.hpp"
#include "plant/plant.hpp"
#include "service/documents/document_service.hpp"

namespace fitgauge::connections {

/// How far an outgoing connection has come. Kept in the database beside what it follows.
struct Progress {
  std::int64_t position = 0;  ///< the last measurement that is dealt with
  std::int64_t planned = 0;   ///< what goes out together next ends there; up to `position`: nothing
  std::optional<std::int64_t> event{};  ///< the last stored event that is dealt with
  std::uint64_t refused = 0;
  std::vector<DeadLetter> dead_letters{};  ///< the newest first

  /// Keeps the newest of them.
  void refuse(DeadLetter letter);
};

/// None where the connection has not begun. Waits. @errors those of storage.
Result<std::optional<Progress>> load_progress(app::DocumentService& documents,
                                              const std::string& name);
Result<void> save_progress(app::DocumentService& documents, const std::string& name,
                           const Progress& progress);
/// The number of a new session with the other side: 0 at first, one more each time, 0 after 255;
/// kept before it is given. Waits. @errors those of storage.
Result<std::uint8_t> next_session(app::DocumentService& documents, const std::string& name);
/// Forgets both, also where there is none.
Result<void> forget_progress(app::DocumentService& documents, const std::string& name);

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

#pragma once

#include "base/thread.hpp"
#include "plant/plant.hpp"
#include "plant/settings.hpp"
#include "service/documents/document_service.hpp"
#include "service/events/event_service.hpp"

namespace fitgauge::connections {

/// Position of an outgoing connection, stored in the database.
struct Progress {
  std::int64_t position = 0;            ///< the last measurement that is dealt with
  std::int64_t planned = 0;             ///< end of the next delivery; up to `position`: none
  std::optional<std::int64_t> event{};  ///< the last stored event that is dealt with
  std::uint64_t refused = 0;
  std::vector<DeadLetter> dead_letters{};  ///< the newest first

  /// Keeps the newest of them.
  void refuse(DeadLetter letter);
};

/// Returns the progress; none if the connection has not begun. Blocks. @errors those of storage.
Result<std::optional<Progress>> load_progress(app::DocumentService& documents,
                                              const std::string& name);
Result<void> save_progress(app::DocumentService& documents, const std::string& name,
                           const Progress& progress);
/// Number of a new session with the other side: 0 at first, then one more each time, 0 after 255;
/// stored before it is returned. Blocks. @errors those of storage.
Result<std::uint8_t> next_session(app::DocumentService& documents, const std::string& name);
/// Deletes both, if they exist.
Result<void> forget_progress(app::DocumentService& documents, const std::string& name);

/// Start of a replay: `{"from": …}`.
struct ReplayOrder {
  std::string from{};
};

template <class V>
void members(V& v, ReplayOrder& order) {
  v.member("from", order.from, api::Text{64},
           "The id of a measurement or of an event (e17-…), or an RFC 3339 time");
}

/// Moves the position back, so that everything after it is sent again: from the id of a measurement
/// the measurements, from an event the events, from a time both. Blocks.
/// @errors RequestInvalid with `/from`, also for a place that was not sent yet; those of storage.
Result<void> move_back(Progress& progress, const ReplayOrder& order, const Plant& plant);

/// A measurement on its way out.
using Outgoing = std::unique_ptr<const app::KeptMeasurement>;

/// An event that is no measurement, on its way out.
struct OutgoingEvent : app::EventService::Stored {
  std::string name{};  ///< its id on the outside, if it is stored nowhere
};

/// The id of such an event on the outside.
std::string event_text(const OutgoingEvent& event);

/// Progress of a delivery.
struct Delivery {
  std::size_t dealt_with = 0;         ///< of the pending measurements, from the first
  std::vector<DeadLetter> refused{};  ///< among these: for good
  std::uint64_t files = 0;
  std::uint64_t bytes = 0;
  std::optional<std::string> failure{};        ///< why it went no further
  std::optional<std::chrono::seconds> wait{};  ///< before the next attempt, as the other side asked
  bool wants_no_more = false;                  ///< for ever
};

/// Maximum of one delivery, so that the position is stored soon.
inline constexpr std::chrono::milliseconds kLongestStretch{500};

/// The other side of an outgoing connection. Used by one thread.
class Outlet {
 public:
  Outlet& operator=(Outlet&&) = delete;  // neither copied nor moved
  virtual ~Outlet() = default;

  /// Delivers at least one measurement, in order, or returns a failure. The next call gets the
  /// rest. Blocks, and ends soon after a stop.
  virtual Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) = 0;

  /// Delivers events, for outlets whose options ask for some.
  virtual Delivery deliver_events(std::span<const OutgoingEvent> events, const std::stop_token&) {
    return {.dealt_with = events.size()};
  }

  /// Called without data to deliver: at least every 30 s, and soon after `wake`. For connections
  /// that stay open. @returns an attempt, or none if there was nothing to do.
  virtual std::optional<Delivery> idle(const std::stop_token&) { return std::nullopt; }
  /// Called first. @param wake may be called on any thread while the outlet exists.
  virtual void wake_by(std::function<void()>) {}
};

inline constexpr std::string_view kRecorded = "measurement.recorded";

/// The common part of outgoing connections.
struct FollowerOptions {
  std::string name{};
  LogFilter filter{};
  /// Events that are sent in addition to measurements; while settings are read, with measurements.
  std::set<std::string, std::less<>> events{std::string(kRecorded)};
  bool from_beginning = false;             ///< of the log; otherwise from now on
  std::chrono::seconds longest_wait{300};  ///< between two failed attempts
  std::chrono::seconds gather{0};          ///< younger data waits for more
  /// A batch is decided before it is sent, so that the same batch is sent after a kill.
  bool plans = false;
};

/// Stores the start of a new connection: it misses nothing later. Blocks. @errors of storage.
Result<Progress> begin_progress(const FollowerOptions& options, const Plant& plant);

/// Follows the log of measurements and gives measurements that pass the filter to an outlet, in
/// order and at least once. Stores its position in the database at most a second later. Repeats a
/// failed attempt after 1 s, 2 s, 4 s and so on, the first failure after a success at once. A
/// writer never waits for it.
std::unique_ptr<Worker> follow(FollowerOptions options, std::unique_ptr<Outlet> outlet,
                               const Plant& plant);

}  // namespace fitgauge::connections

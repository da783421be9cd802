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
class LogFollower final : public Worker {
 public:
  /// Reads its start from the storage; blocks. @param plant must outlive it.
  LogFollower(FollowerOptions options, std::unique_ptr<Outlet> outlet, const Plant& plant);
  ~LogFollower() override;

  void request_stop() override { thread_.request_stop(); }

 private:
  using Time = std::chrono::steady_clock::time_point;
  class Bell;

  void run(bool& has_begun, const std::stop_token& stop);
  bool begin();
  /// Reads the next data, if there is room. @errors those of storage.
  Result<void> read();
  /// Reads the next events, if there is room.
  Result<void> read_events();
  /// Finds the new offsets after the values that were delivered.
  void find_offsets(const std::stop_token& stop);
  void take_log_end(std::int64_t end) {
    log_end_ = end;
    if (events_behind_ == 0 && !pending_events_.empty()) events_behind_ = end;
  }
  void deliver(const std::stop_token& stop);
  /// Whether events go out now: when all measurements that were stored before them are dealt with.
  bool has_events() const {
    return !pending_events_.empty() && pending_.empty() && read_to_ >= events_behind_;
  }
  void deliver_events(const std::stop_token& stop);
  /// Returns the number of pending measurements that go out now.
  std::size_t ripe() const;
  /// @returns the number of the next delivery; none while it cannot be stored.
  std::size_t planned(std::size_t count);
  /// @param measurements of it that went out
  void take(const Delivery& delivery, std::size_t measurements);
  /// Saves unless it did so less than a second ago. @returns whether nothing is left to save.
  bool save(bool at_once);
  void show();

  const FollowerOptions options_;
  const std::unique_ptr<Outlet> outlet_;
  const std::shared_ptr<Bell> bell_;

  // Used only by the thread.
  Progress progress_;
  std::int64_t read_to_ = 0;  ///< all up to here is pending or dealt with
  std::int64_t log_end_ = 0;  ///< of the log, when it was read last
  std::vector<Outgoing> pending_;
  std::vector<OutgoingEvent> pending_events_;
  /// A characteristic and its machine.
  using Made = std::pair<std::optional<std::string>, std::optional<std::string>>;
  std::set<Made> made_;               ///< of the values since their offsets were found
  std::map<Made, std::string> told_;  ///< of these offsets
  std::int64_t events_behind_ = 0;    ///< the measurement before them; 0: none is pending
  std::chrono::seconds pause_{0};     ///< before the next attempt; 0: the last went well
  bool repeats_at_once_ = false;      ///< a refusal: the last attempt went well
  bool is_dirty_ = false;
  bool cannot_read_ = false;
  Time saved_at_{};

  Thread thread_;  // last: it uses all above
};

}  // namespace fitgauge::connections

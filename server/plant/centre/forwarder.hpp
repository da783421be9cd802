#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "base/thread.hpp"
#include "plant/centre/centre_link.hpp"
#include "plant/centre/follower.hpp"
#include "service/log/log_outbox.hpp"

namespace fitgauge::forwarder {

struct ForwarderOptions {
  CentreOptions centre{};
  /// The event's name and a sentence, for the log of the service; called on the thread.
  std::function<void(std::string_view event, const std::string& detail)> tell{};
};

/// Sends this folder's log to its centre, batch by batch, and takes what the centre hands on, on a
/// thread of its own that no writer waits for. After a failure it waits, twice as long each time,
/// up to half a minute.
class Forwarder {
 public:
  /// Asks the centre first, for some seconds at most, what it hands on.
  Forwarder(app::LogOutbox outbox, app::RevisionIntake intake, ForwarderOptions options);
  ~Forwarder();
  Forwarder(const Forwarder&) = delete;
  Forwarder& operator=(const Forwarder&) = delete;

  struct State {
    std::int64_t rows = 0;            ///< that the centre does not have
    std::optional<Timestamp> oldest;  ///< when the first of them was received
    std::string failure;              ///< why the last batch did not get there; empty: it did
    bool is_refused = false;          ///< by the centre, as things are
  };
  State state() const;

 private:
  using Steady = std::chrono::steady_clock;
  /// What became of a batch.
  enum class Sent { Nothing, Taken, Failed, Refused };

  void run(const std::stop_token& stop);
  void follow(const CentreLink::GoesOn& goes_on);
  CentreLink::GoesOn goes_on(const std::stop_token& stop);
  Sent send(const std::stop_token& stop);
  Sent answered(const http_client::HttpAnswer& answer, std::int64_t end);
  Sent elsewhere(std::int64_t size, const std::string& root);
  Sent failed(Sent how, const std::string& why);
  Sent forked(const std::string& why);
  void took(std::int64_t size);
  void look();
  bool wait(const std::stop_token& stop, std::chrono::milliseconds time);

  const app::LogOutbox outbox_;
  const ForwarderOptions options_;
  CentreLink link_;
  Follower follower_;
  bool lacks_records_ = false;  ///< the centre said so of records that were taken as its own
  std::atomic<std::int64_t> confirmed_{0};
  std::atomic<std::int64_t> seen_{0};  ///< records there were at the last look
  std::int64_t most_rows_ = app::LogOutbox::kMostRows;
  std::chrono::milliseconds pause_{0};
  Steady::time_point looked_{};
  std::minstd_rand random_{std::random_device{}()};
  mutable std::mutex mutex_;
  State state_;
  Thread thread_;
};

}  // namespace fitgauge::forwarder

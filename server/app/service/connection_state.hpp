#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.hpp"

namespace fitgauge::app {

/// What a connection to the world outside has done since the start.
struct ConnectionState {
  std::string name{};
  std::string kind{};     ///< lsv2
  std::string address{};  ///< host:port
  std::string machine{};  ///< of its measurements
  std::vector<std::string> paths{};
  std::int64_t interval_seconds = 0;

  bool is_failing = false;   ///< its last attempt was in vain
  std::string last_error{};  ///< of the last attempt that failed; empty: none did
  std::optional<Timestamp> last_attempt_at{};
  std::optional<Timestamp> last_success_at{};
  std::uint64_t attempts = 0;
  std::uint64_t failures = 0;      ///< of those
  std::uint64_t files = 0;         ///< fetched because they were new or had changed
  std::uint64_t bytes = 0;         ///< of those
  std::uint64_t logs = 0;          ///< read in them, whether new or not
  std::uint64_t measurements = 0;  ///< stored
  std::uint64_t values_kept = 0;   ///< that are no size and stay in their file
  std::uint64_t unreadable = 0;    ///< places that no reader understood
};

}  // namespace fitgauge::app

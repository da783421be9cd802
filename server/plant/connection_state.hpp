#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"

namespace fitgauge::connections {

/// What the other side of a connection refused for good.
struct DeadLetter {
  std::string measurement{};  ///< its id
  std::string reason{};
  Timestamp at{};
};

/// A connection to the world outside, and what it has done since the start.
struct ConnectionState {
  std::string name{};
  std::string kind{};
  std::string settings{};     ///< JSON object: all but its secrets
  bool is_outgoing = false;   ///< follows the log; else it brings measurements
  bool is_read_only = false;  ///< stands in the configuration file

  bool is_failing = false;   ///< its last attempt was in vain
  bool is_stopped = false;   ///< for good: the other side wants no more
  std::string last_error{};  ///< of the last attempt that failed; empty: none did
  std::optional<Timestamp> last_attempt_at{};
  std::optional<Timestamp> last_success_at{};
  std::optional<Timestamp> attempt_began_at{};  ///< of the attempt that is under way
  std::chrono::steady_clock::time_point attempt_began{};

  // Of outgoing ones.
  std::optional<std::int64_t> position{};  ///< how many measurements of the log are dealt with
  std::int64_t behind = 0;                 ///< how many are not
  std::optional<Timestamp> waits_since{};  ///< when what is to go next was received
  std::vector<DeadLetter> dead_letters{};  ///< the newest first; a bounded number

  std::uint64_t attempts = 0;
  std::uint64_t failures = 0;      ///< of those
  std::uint64_t files = 0;         ///< taken or written
  std::uint64_t bytes = 0;         ///< of those
  std::uint64_t logs = 0;          ///< read in them, whether new or not
  std::uint64_t measurements = 0;  ///< stored, or told to the other side
  std::uint64_t values_kept = 0;   ///< angles and figures of axes, which stay in their file
  std::uint64_t unreadable = 0;    ///< places that no reader understood, files that were refused
  std::uint64_t refused = 0;       ///< dead letters, with those that are no more listed
};

/// Since when nothing was dealt with, in nanoseconds; none before the first success.
/// Of an outgoing connection the age of what is to go next, of another since its last success.
std::optional<std::int64_t> lag(const ConnectionState& state, Timestamp now);

/// No step of an attempt takes longer, unless the other side or a file holds it up.
inline constexpr std::chrono::seconds kLongestStep{60};

/// Whether the attempt under way stands still.
bool hangs(const ConnectionState& state, std::chrono::steady_clock::time_point now);

/// A counter of all connections, by the name it has in JSON.
struct ConnectionCounter {
  std::string_view name;
  std::uint64_t ConnectionState::*value;
  std::string_view meaning;
};
inline constexpr std::array<ConnectionCounter, 9> kConnectionCounters = {{
    {"attempts", &ConnectionState::attempts, "Since the start, as all that follow"},
    {"failures", &ConnectionState::failures, "Attempts that failed"},
    {"files", &ConnectionState::files, "Files taken because they were new, or written"},
    {"bytes", &ConnectionState::bytes, "Bytes of these files"},
    {"logs", &ConnectionState::logs, "Measuring logs read in them, whether new or not"},
    {"measurements", &ConnectionState::measurements, "Stored, or told to the other side"},
    {"values_kept", &ConnectionState::values_kept,
     "Angles and figures of axes, which stay in the file"},
    {"unreadable", &ConnectionState::unreadable,
     "Places that no reader understood, files that were refused"},
    {"refused", &ConnectionState::refused, "Measurements that the other side refused for good"},
}};

/// What a test of a connection found.
struct ConnectionTest {
  bool ok = false;
  std::string detail{};
};

}  // namespace fitgauge::connections

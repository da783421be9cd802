#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/clock.hpp"

namespace fitgauge::connections {

/// The types of the specification that we send (3.0, 6.4.16 "Data Types").
enum class SparkplugType : std::uint32_t {
  Int64 = 4,
  Double = 10,
  Boolean = 11,
  String = 12,
  DateTime = 13
};

/// Null, truth, whole number (of DateTime in milliseconds), number, text.
using SparkplugValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct SparkplugMetric {
  std::string name{};                    ///< in births and deaths; else empty
  std::optional<std::uint64_t> alias{};  ///< goes for the name in data
  std::optional<SparkplugType> type{};   ///< in births and deaths
  Timestamp at{};
  SparkplugValue value{};
};

/// Since 1970; what was before is 0: the payload has no sign for times.
std::int64_t milliseconds(Timestamp time);

/// The bytes of a payload. @param seq none in a death of the node.
std::string sparkplug_payload(Timestamp sent_at, std::optional<std::uint8_t> seq,
                              const std::vector<SparkplugMetric>& metrics);

inline constexpr std::string_view kRebirth = "Node Control/Rebirth";

/// Whether a command asks for all births. What is no payload asks for nothing.
bool asks_for_rebirth(std::string_view payload);

}  // namespace fitgauge::connections

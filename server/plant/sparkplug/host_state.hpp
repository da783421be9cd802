#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace fitgauge::connections {

/// Whether the primary host is there, by the STATE messages that have come.
class HostState {
 public:
  /// One that is older than the last, or no STATE at all, changes nothing.
  void take(std::string_view payload);
  /// A new connection: what the broker has kept of it comes anew.
  void forget() { is_online_ = false; }
  bool is_online() const { return is_online_; }

 private:
  bool is_online_ = false;
  std::optional<std::int64_t> timestamp_{};
};

}  // namespace fitgauge::connections

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "base/descriptor.hpp"
#include "plant/lsv2/link/link_failure.hpp"
#include "plant/lsv2/link/telegram.hpp"

namespace fitgauge::control_link {

inline constexpr std::uint16_t kControlPort = 19000;

struct ControlAddress {
  std::string host{};
  std::uint16_t port = kControlPort;
};

/// `10.0.0.7`, `tnc.local:19000`, `[fe80::1]:19000`. Nothing where it cannot be read.
std::optional<ControlAddress> parse_control_address(std::string_view text);
/// As parse_control_address reads it.
std::string to_text(const ControlAddress& address);

struct LinkClientOptions {
  ControlAddress address{};
  std::chrono::milliseconds connect_timeout = std::chrono::seconds(10);
  std::chrono::milliseconds answer_timeout = std::chrono::seconds(30);  ///< of each telegram
  std::stop_token stop{};  ///< ends every wait within a tenth of a second
};

/// A connection to a control that sends and receives whole telegrams; waits, for one thread.
/// After a failure it has no meaning any more.
class LinkSocket {
 public:
  /// @errors NotReached, Stopped
  static LinkResult<LinkSocket> connect(LinkClientOptions options);

  /// @errors Broken, Stopped
  LinkResult<void> send(const Telegram& telegram);
  /// @errors Broken: closed, silent for too long, or no telegram; Stopped
  LinkResult<Telegram> receive();

  const ControlAddress& address() const { return options_.address; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  explicit LinkSocket(LinkClientOptions options);
  /// Until the socket can be read or written. @errors Broken, Stopped
  LinkResult<void> wait(short events, Time deadline) const;
  LinkFailure broken(std::string_view what) const;

  LinkClientOptions options_;
  Descriptor socket_;
  TelegramReader reader_;
};

}  // namespace fitgauge::control_link

#pragma once

#include <poll.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/descriptor.hpp"
#include "plant/lsv2/link/link_server.hpp"

namespace fitgauge::control_link {

/// Why a connection ends; empty: the client has left.
struct Ending {
  std::string_view why{};
};

/// One client of a LinkServer: its socket, which never blocks, and its conversation. One answer at
/// a time: the next telegram is looked at when the last answer has left.
class Connection {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Connection(Descriptor socket, std::string peer, std::unique_ptr<Conversation> conversation,
             Time now);

  const std::string& peer() const { return peer_; }
  /// What it waits for.
  pollfd interest() const;
  /// When it is to end unless something happens, and why.
  std::pair<Time, std::string_view> deadline(const LinkServerOptions& options) const;

  std::optional<Ending> read(Time now);
  std::optional<Ending> write(Time now);

 private:
  std::optional<Ending> answer(Time now);
  std::optional<Ending> send_some();

  Descriptor socket_;
  std::string peer_;
  std::unique_ptr<Conversation> conversation_;
  TelegramReader reader_;
  std::string out_;
  Time since_;  ///< of what it is doing: reading a telegram, writing an answer, being silent
};

}  // namespace fitgauge::control_link

#pragma once

#include "plant/lsv2/link/payload.hpp"

namespace fitgauge::connections {
class TcpListener;
}

namespace fitgauge::control_link {

/// One client's talk with a control. Lives on the server's thread.
class Conversation {
 public:
  Conversation& operator=(Conversation&&) = delete;  // neither copied nor moved
  virtual ~Conversation() = default;

  /// The response, if the protocol has one. May wait for the disk, and so do other clients.
  virtual std::optional<Telegram> answer(const Telegram& telegram) = 0;
  /// The agreed size; telegrams of both sides are shorter.
  virtual std::size_t buffer() const = 0;
};

struct LinkServerOptions {
  std::string host{};  ///< a numeric address
  std::uint16_t port = 0;
  std::size_t most_connections = 100;  ///< beyond it a client is closed at once
  std::chrono::milliseconds telegram_timeout = std::chrono::seconds(60);  ///< begun, not whole
  std::chrono::milliseconds idle_timeout = std::chrono::minutes(10);
  std::chrono::milliseconds write_timeout = std::chrono::seconds(60);  ///< a client reads nothing
};

struct LinkServerHooks {
  std::function<std::unique_ptr<Conversation>()> converse;
  /// Reports a client that was refused or disconnected: its address and the reason.
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// Serves LSV-2 on one thread: enough for a hundred connections with one telegram at a time. Each
/// uses at most three buffers of 4096 bytes and the state of its session.
class LinkServer {
 public:
  /// Binds, listens and starts the thread, which ends with it. @errors ListenFailed.
  static Result<std::unique_ptr<LinkServer>> start(LinkServerOptions options,
                                                   LinkServerHooks hooks);
  ~LinkServer();
  LinkServer& operator=(LinkServer&&) = delete;  // neither copied nor moved

  std::uint16_t port() const;

 private:
  LinkServer(LinkServerOptions options, LinkServerHooks hooks);

  const LinkServerOptions options_;
  const LinkServerHooks hooks_;
  std::size_t connections_ = 0;
  std::unique_ptr<connections::TcpListener> listener_;  // last: it closes every connection
};

}  // namespace fitgauge::control_link

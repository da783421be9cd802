#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/result.hpp"
#include "http/engine/io_thread.hpp"
#include "http/server.hpp"

namespace fitgauge::http {

/// One listening socket, served by the first I/O thread, that deals its connections to all threads
/// in turn. Belongs to that thread after start().
class Listener {
 public:
  /// Called on the first I/O thread with a connected socket of its own, for the given thread.
  using Deliver = std::function<void(IoThread&, Socket, Peer)>;

  /// Binds and listens.
  /// @errors ListenFailed with the address and the system's reason.
  static Result<std::unique_ptr<Listener>> open(const ListenAddress& address,
                                                std::vector<IoThread*> threads, Deliver deliver);

  std::uint16_t port() const { return port_; }
  void start() { accept(); }
  void close();

 private:
  Listener(std::vector<IoThread*> threads, Deliver deliver);
  void accept();
  void deal(Socket socket);

  std::vector<IoThread*> threads_;
  Deliver deliver_;
  Acceptor acceptor_;
  Timer retry_;
  std::uint16_t port_ = 0;
  std::size_t next_ = 0;
  bool health_only_ = false;
};

}  // namespace fitgauge::http

#pragma once

#include <memory>
#include <vector>

#include "http/engine/asio.hpp"

namespace fitgauge::http {

class Connection;

/// Decides when the connections of one I/O thread read their next requests. Straight after an
/// answer a read finds nothing, a system call in vain: the client has yet to see the answer. Behind
/// the turn of all connections that are ready it mostly finds the next request while clients keep
/// the thread busy; it then spares that call and Asio's wait for an event. So reads are put off to
/// the end of the turn while at least half of them find something there. Otherwise, as with a
/// client that is alone, connections wait for the event of their socket, and after a number of
/// answers a turn tries again. Belongs to its thread.
class NextReads {
 public:
  explicit NextReads(asio::io_context& context) : context_(context) {}

  /// Puts the read off: calls read_in_turn() at the end of the turn.
  /// @returns false when the connection has to wait for its socket instead.
  bool put(Connection& connection);

 private:
  void read();

  asio::io_context& context_;
  std::vector<std::shared_ptr<Connection>> waiting_;
  std::vector<std::shared_ptr<Connection>> turn_;  ///< being read
  unsigned until_retry_ = 0;  ///< so many are not put off before a turn tries again
};

}  // namespace fitgauge::http

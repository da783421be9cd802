#pragma once

#include <functional>
#include <stop_token>
#include <string_view>
#include <thread>

namespace fitgauge {

/// A thread whose work no exception ends: what the body throws is a bug, reported as of `place`,
/// and after a short rest the body begins again, until it returns or a stop was asked for. No other
/// thread is started anywhere (tests/layering). Its destructor asks it to stop and waits. `top -H`
/// shows the first 15 bytes of `place`, without its article.
class Thread {
 public:
  using Body = std::function<void(const std::stop_token& stop)>;

  Thread() = default;
  /// @param place outlives the thread: a literal.
  Thread(std::string_view place, Body body);

  void request_stop() { thread_.request_stop(); }
  std::stop_token stop_token() const { return thread_.get_stop_token(); }
  /// Asks it to stop and waits until it has ended; does nothing when it has not begun or has ended.
  void stop();
  /// Leaves it to itself: it ends with the process.
  void detach() { thread_.detach(); }
  /// It has begun, and stop() was not called.
  bool has_begun() const { return thread_.joinable(); }

 private:
  std::jthread thread_;
};

}  // namespace fitgauge

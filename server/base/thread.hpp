#pragma once

#include <future>

namespace fitgauge {

/// Receives each exception that a border has caught: `place` names the border, `what` is the
/// exception's text. Called on any thread; must not throw.
using BugReport = void (*)(std::string_view place, std::string_view what);

/// Sets the reporter of bugs, before other threads start; the default is stderr.
void report_bugs_to(BugReport report);
void report_bug(std::string_view place, std::string_view what) noexcept;

/// Calls foreign code (a completion, a job, a listener) at a border that no exception may pass: the
/// loop of a thread, a destructor, one of many callbacks in a row. An exception there is a bug: it
/// is reported once and ends nothing but the call.
/// @returns whether `function` returned.
template <class Function>
bool guarded(std::string_view place, Function&& function) noexcept {
  try {
    std::forward<Function>(function)();
    return true;
  } catch (const std::exception& bug) {
    report_bug(place, bug.what());
  } catch (...) {
    report_bug(place, "an exception of unknown type");
  }
  return false;
}

/// The error of work that a stop ends or refuses.
Error shutting_down();

/// Waits for this time, or until a stop is requested. @returns false after a stop.
bool wait_unless_stopped(const std::stop_token& stop, std::chrono::nanoseconds time);

/// A thread that survives exceptions: an exception is reported as a bug at `place`, and the body
/// begins again after a short rest, until it returns or a stop is requested. All threads are
/// started here (tests/layering). The destructor requests a stop and waits. `top -H` shows the
/// first 15 bytes of `place` without its article.
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

/// Waits for the result that `begin(done)` passes to `done`, on this thread or another.
template <class T, class Begin>
Result<T> wait_for_result(const Begin& begin) {
  std::promise<Result<T>> promise;
  auto future = promise.get_future();
  begin([&promise](Result<T> result) { promise.set_value(std::move(result)); });
  return future.get();
}

/// An immutable value that every thread reads and one replaces; readers keep their copy.
/// Thread-safe. Uses a mutex, because ThreadSanitizer reports the lock of libstdc++ 12's
/// std::atomic<std::shared_ptr> as a race.
template <class T>
class Snapshot {
 public:
  explicit Snapshot(std::shared_ptr<const T> value = nullptr)
      : value_(std::move(value)), current_(value_.get()) {}

  std::shared_ptr<const T> get() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

  /// Whether `kept` is still the value. The caller owns `kept` too. Takes no lock.
  bool is(const T* kept) const { return current_.load(std::memory_order_acquire) == kept; }

  void set(std::shared_ptr<const T> value) {
    {
      const std::lock_guard lock(mutex_);
      value_.swap(value);
      current_.store(value_.get(), std::memory_order_release);
    }
    // The old value, if this was its last owner, is destroyed outside the lock.
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
  std::atomic<const T*> current_;
};

}  // namespace fitgauge

#include "daemon/log.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace fitgauge::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Between two batches, so that a busy service wakes the thread 100 times a second, not once a
/// line.
constexpr milliseconds kPause{10};
/// The bytes that a pipe accepts at once when poll() calls it writable (PIPE_BUF on Linux).
constexpr std::size_t kPiece = 4096;

bool is_regular_file(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

std::uint64_t lines_in(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The next bytes to write: whole lines if they fit, so that other writers of a pipe do not split
/// them.
std::string_view next_piece(std::string_view text) {
  if (text.size() <= kPiece) return text;
  const std::size_t end = text.rfind('\n', kPiece - 1);
  return text.substr(0, end == std::string_view::npos ? kPiece : end + 1);
}

std::string lost_line(std::uint64_t lines) {
  std::string line;
  append_event_line(
      line, LogLevel::Warning, "log_lines_lost",
      fmt::format("{} lines were lost: the reader of the log was too slow or absent", lines));
  return line;
}

}  // namespace

struct LogQueue::State {
  State(int to, std::size_t bytes) : descriptor(to), room(bytes), regular(is_regular_file(to)) {}

  const int descriptor;
  const std::size_t room;
  const bool regular;

  std::mutex mutex;
  std::condition_variable changed;
  std::string waiting;  ///< whole lines
  bool closing = false;
  steady_clock::time_point give_up{};  ///< when closing
  bool ended = false;
  std::atomic<std::uint64_t> lost{0};

  bool out_of_time() {
    const std::lock_guard lock(mutex);
    return closing && steady_clock::now() >= give_up;
  }

  /// Waits until a write of kPiece bytes does not block. @returns false when there is no more time.
  bool wait_for_room() {
    while (!regular) {
      pollfd wanted{.fd = descriptor, .events = POLLOUT, .revents = 0};
      if (poll(&wanted, 1, 100) > 0) return true;
      if (out_of_time()) return false;
    }
    return true;
  }

  /// Writes `text`; counts unwritten text as lost.
  void write_all(std::string_view text) {
    while (!text.empty()) {
      const std::string_view piece = regular ? text : next_piece(text);
      const ssize_t count =
          wait_for_room() ? ::write(descriptor, piece.data(), piece.size()) : ssize_t{-1};
      if (count < 0 && (errno == EINTR || errno == EAGAIN) && !out_of_time()) continue;
      if (count < 0) {
        lost += lines_in(text);
        return;
      }
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void run() {
    std::string batch;
    std::uint64_t said = 0;
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return closing || !waiting.empty(); });
      batch.clear();
      batch.swap(waiting);
      lock.unlock();
      write_all(batch);
      if (const std::uint64_t now = lost; now != said && !out_of_time()) {
        write_all(lost_line(now - said));
        said = now;
      }
      lock.lock();
      if (closing && waiting.empty()) break;
      changed.wait_for(lock, kPause, [&] { return closing; });
    }
    ended = true;
    changed.notify_all();
  }
};

LogQueue::LogQueue(int descriptor, std::size_t room)
    : state_(std::make_shared<State>(descriptor, room)) {
  // Signals are for the main thread, which may not wait for them yet.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = Thread("the log's writer", [state = state_](const auto&) { state->run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LogQueue::~LogQueue() {
  {
    std::unique_lock lock(state_->mutex);
    state_->closing = true;
    state_->give_up = steady_clock::now() + kPatience;
    state_->changed.notify_all();
    if (!state_->changed.wait_for(lock, kPatience * 2, [&] { return state_->ended; })) {
      thread_.detach();
      return;
    }
  }
  thread_.stop();
}

void LogQueue::push(std::string_view line, Kind kind) {
  const std::size_t room = kind == Kind::Request ? state_->room / 4 * 3 : state_->room;
  bool wake = false;
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->waiting.size() + line.size() > room) {
      ++state_->lost;
      return;
    }
    wake = state_->waiting.empty();
    state_->waiting += line;
  }
  if (wake) state_->changed.notify_one();
}

std::uint64_t LogQueue::lost() const { return state_->lost; }

}  // namespace fitgauge::daemon

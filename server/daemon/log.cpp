#include "daemon/log.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <concepts>
#include <csignal>
#include <ctime>

#include "api/wire/request_facts.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::daemon {
namespace {

constexpr std::string_view kLevels[] = {"debug", "info", "warning", "error", "off"};

/// A field of a request is text of the client: if it is longer than a few addresses, it is ignored.
constexpr std::size_t kMostForwarded = 200;
constexpr std::size_t kMostMethod = 32;

/// `00`, `01` and so on: two digits take the time of one.
template <unsigned base>
constexpr auto kDigitPairs = [] {
  std::array<std::array<char, 2>, base * base> pairs{};
  for (unsigned i = 0; i < pairs.size(); ++i)
    pairs[i] = {"0123456789abcdef"[i / base], "0123456789abcdef"[i % base]};
  return pairs;
}();

/// The text of one line in a fixed buffer. A text without room is left out; all are bounded.
class Line {
 public:
  void put(std::string_view text) {
    if (text.empty() || text.size() > left()) return;
    std::memcpy(end_, text.data(), text.size());
    end_ += text.size();
  }
  /// A literal, whose length the compiler knows: no call copies it.
  template <std::size_t size>
  void put(const char (&literal)[size]) {
    if (size - 1 > left()) return;
    std::memcpy(end_, literal, size - 1);
    end_ += size - 1;
  }
  template <std::integral Number>
  void put(Number number) {
    const fmt::format_int digits(number);
    put(std::string_view(digits.data(), digits.size()));
  }
  /// The last `count` digits in base `base`, with leading zeros.
  template <unsigned base, std::size_t count, std::unsigned_integral Number>
  void put_digits(Number number) {
    static_assert(count % 2 == 0);
    if (count > left()) return;
    for (char* to = end_ + count; to != end_; number /= base * base) {
      to -= 2;
      std::memcpy(to, kDigitPairs<base>[number % (base * base)].data(), 2);
    }
    end_ += count;
  }

  /// Appends the text to `out` and begins anew.
  std::string& flush_to(std::string& out) {
    out.append(room_.begin(), end_);
    end_ = room_.begin();
    return out;
  }

 private:
  std::size_t left() const { return static_cast<std::size_t>(room_.end() - end_); }

  std::array<char, 1024> room_;
  char* end_ = room_.begin();
};

/// `{"time":"2026-11-22T08:00:00.`, made anew once a second for each thread.
std::string_view beginning_of(std::time_t second) {
  thread_local std::time_t last = -1;
  thread_local char text[40];
  thread_local std::size_t size = 0;
  if (second != last) {
    std::tm parts{};
    gmtime_r(&second, &parts);
    size = std::strftime(text, sizeof text, R"({"time":"%Y-%m-%dT%H:%M:%S.)", &parts);
    last = second;
  }
  return {text, size};
}

void begin(Line& line, LogLevel level) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  line.put(beginning_of(now.tv_sec));
  line.put_digits<10, 6>(static_cast<std::uint32_t>(now.tv_nsec / 1000));
  line.put(R"(Z","level":")");
  line.put(kLevels[static_cast<std::size_t>(level)]);
  line.put(R"(","event":)");
}

/// Returns the client that a proxy names: only printable ASCII, cut to the limit of the log.
std::optional<std::string> forwarded_for(const http::Request& request) {
  if (!request.is_forwarded()) return std::nullopt;
  const auto field = request.header("X-Forwarded-For");
  const auto forwarded = field ? field : request.header("Forwarded");
  if (!forwarded) return std::nullopt;
  std::string text(forwarded->substr(0, kMostForwarded));
  std::ranges::replace_if(
      text, [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text;
}

std::unique_ptr<LogQueue> queue;
LogLevel least = LogLevel::Off;

/// If a standard descriptor is closed, the next opened file would become the log's.
void occupy_standard_descriptors() {
  int descriptor = 0;
  while ((descriptor = ::open("/dev/null", O_RDWR | O_CLOEXEC)) >= 0 &&
         descriptor <= STDERR_FILENO) {
  }
  if (descriptor >= 0) close(descriptor);
}

template <class Append>
void write(LogLevel level, LogQueue::Kind kind, Append append) {
  if (queue == nullptr || level < least) return;
  thread_local std::string line;
  line.clear();
  append(line);
  queue->push(line, kind);
}

void log_event(LogLevel level, std::string_view event, std::string_view detail) {
  write(level, LogQueue::Kind::Other,
        [&](std::string& line) { append_event_line(line, level, event, detail); });
}

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Between two batches: a busy service wakes the thread 100 times a second, not once a line.
constexpr milliseconds kPause{10};
/// The bytes that a pipe accepts at once when poll() calls it writable (PIPE_BUF on Linux).
constexpr std::size_t kPiece = 4096;

bool is_regular_file(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

std::uint64_t lines_in(std::string_view text) {
  return static_cast<std::uint64_t>(std::ranges::count(text, '\n'));
}

/// The next bytes to write: whole lines if they fit, which other writers do not split.
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

LogLevel log_level_named(std::string_view word) {
  return static_cast<LogLevel>(std::ranges::find(kLevels, word) - std::begin(kLevels));
}

void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail) {
  Line line;
  begin(line, level);
  append_json_string(line.flush_to(out), event);
  out += ",\"detail\":";
  append_json_string(out, as_utf8(detail));
  out += "}\n";
}

void append_request_line(std::string& out, LogLevel level, const http::FinishedRequest& finished) {
  Line line;
  begin(line, level);
  line.put(R"("request","id":")");
  line.put(finished.request.id_text());  // of characters that need no escape
  line.put(R"(","method":")");
  line.put(finished.method.substr(0, kMostMethod));  // a token: nothing in it needs an escape
  line.put(R"(","route":")");
  line.put(finished.route);  // of ours
  line.put(R"(","status":)");
  line.put(finished.status);
  line.put(R"(,"us":)");
  line.put(finished.microseconds);
  line.put(R"(,"received":)");
  line.put(finished.bytes_received);
  line.put(R"(,"sent":)");
  line.put(finished.bytes_sent);
  if (finished.broken_off) line.put(R"(,"broken_off":true)");
  line.put(R"(,"peer":")");
  line.put(finished.request.peer_address());
  line.put("\"");
  if (const auto* caller = finished.request.caller<api::Caller>()) {
    line.put(",\"caller\":");
    append_json_string(line.flush_to(out), caller->name);
  }
  if (const auto forwarded = forwarded_for(finished.request)) {
    line.put(",\"forwarded_for\":");
    append_json_string(line.flush_to(out), *forwarded);
  }
  line.put("}\n");
  line.flush_to(out);
}

void open_log(const std::string& level) {
  occupy_standard_descriptors();
  least = log_level_named(level);
  queue = std::make_unique<LogQueue>(STDERR_FILENO);
}

void log_request(const http::FinishedRequest& finished) {
  const LogLevel level = http::is_server_error(finished.status) ? LogLevel::Error : LogLevel::Info;
  write(level, LogQueue::Kind::Request,
        [&](std::string& line) { append_request_line(line, level, finished); });
}

void log_info(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Info, event, detail);
}

void log_warning(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Warning, event, detail);
}

void log_error(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Error, event, detail);
}

std::uint64_t log_lines_lost() { return queue == nullptr ? 0 : queue->lost(); }

void close_log() { queue.reset(); }

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

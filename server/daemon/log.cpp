#include "daemon/log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <concepts>
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
  for (unsigned i = 0; i < pairs.size(); ++i) {
    pairs[i] = {"0123456789abcdef"[i / base], "0123456789abcdef"[i % base]};
  }
  return pairs;
}();

/// The text of one line in a fixed buffer. A text without room is left out: the texts have a known
/// maximum length.
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
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
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

}  // namespace

LogLevel log_level_named(std::string_view word) {
  return static_cast<LogLevel>(std::find(std::begin(kLevels), std::end(kLevels), word) -
                               std::begin(kLevels));
}

void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail) {
  Line line;
  begin(line, level);
  append_json_string(line.flush_to(out), event);
  out += ",\"detail\":";
  append_json_string(out, detail);
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
  const LogLevel level = finished.status >= 500 ? LogLevel::Error : LogLevel::Info;
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

}  // namespace fitgauge::daemon

#include "daemon/log_line.hpp"

#include <algorithm>
#include <charconv>
#include <ctime>
#include <iterator>

#include "api/service/caller.hpp"
#include "api/wire/json_writer.hpp"

namespace fitgauge::daemon {
namespace {

constexpr std::string_view kLevels[] = {"debug", "info", "warning", "error", "off"};

/// A field of a request is the client's text: longer than an address or a few, it is none.
constexpr std::size_t kMostForwarded = 200;

template <class Number>
void append(std::string& out, std::string_view name, Number number) {
  char digits[24];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
  out.append(name).append(std::begin(digits), end);
}

void append_digits(std::string& out, std::int64_t number, int digits) {
  out.resize(out.size() + static_cast<std::size_t>(digits));
  for (auto to = out.rbegin(); digits > 0; --digits, ++to) {
    *to = static_cast<char>('0' + number % 10);
    number /= 10;
  }
}

/// `2026-11-22T08:00:00`, made anew once a second for each thread.
std::string_view second_text(std::time_t second) {
  thread_local std::time_t last = -1;
  thread_local char text[32];
  if (second != last) {
    std::tm parts{};
    gmtime_r(&second, &parts);
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
    last = second;
  }
  return text;
}

void begin_line(std::string& out, LogLevel level) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  out.append(R"({"time":")").append(second_text(now.tv_sec)) += '.';
  append_digits(out, now.tv_nsec / 1000, 6);
  out.append(R"(Z","level":")").append(kLevels[static_cast<std::size_t>(level)]);
  out += "\",\"event\":";
}

void append_hexadecimal(std::string& out, std::uint64_t number) {
  for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[number >> shift & 0xf];
}

/// For whom a proxy asks: a field as it came, but printable ASCII and no longer than the log bears.
void append_forwarded(std::string& out, const http::Request& request) {
  const auto field = request.header("X-Forwarded-For");
  const auto forwarded = field ? field : request.header("Forwarded");
  if (!forwarded) return;
  std::string text(forwarded->substr(0, kMostForwarded));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  out += ",\"forwarded_for\":";
  api::append_json_string(out, text);
}

}  // namespace

LogLevel log_level_named(std::string_view word) {
  return static_cast<LogLevel>(std::find(std::begin(kLevels), std::end(kLevels), word) -
                               std::begin(kLevels));
}

void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail) {
  begin_line(out, level);
  api::append_json_string(out, event);
  out += ",\"detail\":";
  api::append_json_string(out, detail);
  out += "}\n";
}

void append_request_line(std::string& out, LogLevel level, const http::FinishedRequest& finished) {
  begin_line(out, level);
  out += R"("request","id":")";
  append_hexadecimal(out, finished.request.id());
  out += R"(","method":)";
  api::append_json_string(out, finished.method);
  out += ",\"route\":";
  api::append_json_string(out, finished.route);
  append(out, ",\"status\":", finished.status);
  append(out, ",\"us\":", finished.microseconds);
  append(out, ",\"received\":", finished.bytes_received);
  append(out, ",\"sent\":", finished.bytes_sent);
  out.append(R"(,"peer":")").append(finished.request.peer_address()) += '"';
  if (const auto* caller = finished.request.caller<api::Caller>()) {
    out += ",\"caller\":";
    api::append_json_string(out, caller->name);
  }
  append_forwarded(out, finished.request);
  out += "}\n";
}

}  // namespace fitgauge::daemon

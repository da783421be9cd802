#include "daemon/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "api/wire/json_writer.hpp"

namespace fitgauge::daemon {
namespace {

void log_event(spdlog::level::level_enum level, std::string_view event, std::string_view detail) {
  std::string members;
  api::append_json_string(members, event);
  members += ",\"detail\":";
  api::append_json_string(members, detail);
  spdlog::log(level, "\"event\":{}", members);
}

}  // namespace

void open_log(const std::string& level) {
  auto logger = std::make_shared<spdlog::logger>("fitgauged",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l",%v})",
                      spdlog::pattern_time_type::utc);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

bool logs_requests() { return spdlog::should_log(spdlog::level::info); }

void log_request(const http::FinishedRequest& request) {
  std::string route;
  api::append_json_string(route, request.route);
  std::string method;
  api::append_json_string(method, request.method);
  spdlog::info(
      R"("event":"request","id":"{:016x}","method":{},"route":{},"status":{},"us":{},"received":{},"sent":{},"peer":"{}")",
      request.id, method, route, request.status, request.microseconds, request.bytes_received,
      request.bytes_sent, request.peer_address);
}

void log_info(std::string_view event, std::string_view detail) {
  log_event(spdlog::level::info, event, detail);
}

void log_warning(std::string_view event, std::string_view detail) {
  log_event(spdlog::level::warn, event, detail);
}

void log_error(std::string_view event, std::string_view detail) {
  log_event(spdlog::level::err, event, detail);
}

void flush_log() { spdlog::default_logger()->flush(); }

}  // namespace fitgauge::daemon

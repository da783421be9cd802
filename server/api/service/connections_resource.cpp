#include "api/service/connections_resource.hpp"

#include "api/wire/json_writer.hpp"

namespace fitgauge::api {
namespace {

using app::ConnectionState;

std::string_view state_word(const ConnectionState& connection) {
  if (connection.is_failing) return "failing";
  return connection.last_success_at ? "ok" : "waiting";
}

void write_time(JsonWriter& json, std::string_view name, const std::optional<Timestamp>& time) {
  json.key(name);
  if (time) {
    json.value(format_rfc3339(*time));
  } else {
    json.null();
  }
}

void write_connection(JsonWriter& json, const ConnectionState& connection, Timestamp now) {
  json.begin_object()
      .member("name", connection.name)
      .member("kind", connection.kind)
      .member("address", connection.address)
      .member("machine", connection.machine)
      .key("paths")
      .begin_array();
  for (const std::string& path : connection.paths) json.value(path);
  json.end_array()
      .member("interval_s", connection.interval_seconds)
      .member("state", state_word(connection));
  write_time(json, "last_attempt_at", connection.last_attempt_at);
  write_time(json, "last_success_at", connection.last_success_at);
  json.key("lag_s");
  if (connection.last_success_at) {
    const std::int64_t lag = now.nanoseconds - connection.last_success_at->nanoseconds;
    json.fixed(static_cast<double>(lag) / 1e9, 3);
  } else {
    json.null();
  }
  json.key("last_error");
  if (connection.last_error.empty()) {
    json.null();
  } else {
    json.value(connection.last_error);
  }
  json.member("attempts", connection.attempts)
      .member("failures", connection.failures)
      .member("files", connection.files)
      .member("bytes", connection.bytes)
      .member("logs", connection.logs)
      .member("measurements", connection.measurements)
      .member("values_kept", connection.values_kept)
      .member("unreadable", connection.unreadable)
      .end_object();
}

Result<http::Response> list(const Services& services) {
  std::string body;
  JsonWriter json(body);
  json.begin_object().key("connections").begin_array();
  if (services.connections) {
    for (const ConnectionState& connection : services.connections()) {
      write_connection(json, connection, services.clock.now());
    }
  }
  json.end_array().end_object();
  return http::Response(200, "application/json", std::move(body)).with("Cache-Control", "no-store");
}

}  // namespace

void add_connections_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/connections",
      .handler = [&services](const http::Request&) { return list(services); },
      .summary = "The connections to controls: state, lag, last error and what they have stored",
      .access = "viewer",
      .operation = "listConnections",
      .tag = "service",
      .outcomes = {{.meaning = "The connections", .schema = "Connections"}},
  });
}

}  // namespace fitgauge::api

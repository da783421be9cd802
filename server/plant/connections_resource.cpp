#include "api/handlers.hpp"
#include "api/resources.hpp"
#include "api/wire/request_facts.hpp"
#include "base/json/json_writer.hpp"
#include "plant/connections.hpp"

namespace fitgauge::connections {
namespace {

using api::JsonWriter;

std::string_view state_word(const ConnectionState& connection) {
  if (connection.is_stopped) return "stopped";
  if (hangs(connection, std::chrono::steady_clock::now())) return "hanging";
  if (connection.is_failing) return "failing";
  return connection.last_success_at ? "ok" : "waiting";
}

std::optional<std::string> text_of(const std::optional<Timestamp>& time) {
  return time ? std::optional(format_rfc3339(*time)) : std::nullopt;
}

/// The members of its settings, next to those of its state.
Result<void> write_settings(JsonWriter& json, const ConnectionState& connection) {
  const auto settings = TRY(parse_stored_json(connection.settings, "a connection"));
  for (const auto& [name, value] : settings.members) {
    if (name == "kind") continue;
    json.key(name);
    write_json(json, value);
  }
  return {};
}

void write_progress(JsonWriter& json, const ConnectionState& connection) {
  json.member("position", connection.position.value_or(0)).member("behind", connection.behind);
  json.key("dead_letters").begin_array();
  for (const DeadLetter& letter : connection.dead_letters) {
    json.begin_object()
        .member("measurement", letter.measurement)
        .member("at", format_rfc3339(letter.at))
        .member("reason", letter.reason)
        .end_object();
  }
  json.end_array();
}

Result<void> write_connection(JsonWriter& json, const ConnectionState& connection, Timestamp now) {
  json.begin_object()
      .member("name", connection.name)
      .member("kind", connection.kind)
      .member("direction", connection.is_outgoing ? "out" : "in")
      .member("read_only", connection.is_read_only);
  TRY(write_settings(json, connection));
  json.member("state", state_word(connection));
  json.member("last_attempt_at", text_of(connection.last_attempt_at));
  json.member("last_success_at", text_of(connection.last_success_at));
  json.member("attempt_began_at", text_of(connection.attempt_began_at));
  json.key("lag_s");
  if (const auto nanoseconds = lag(connection, now)) {
    json.fixed(static_cast<double>(*nanoseconds) / 1e9, 3);
  } else {
    json.null();
  }
  json.member("last_error",
              connection.last_error.empty() ? std::nullopt : std::optional(connection.last_error));
  if (connection.is_outgoing) write_progress(json, connection);
  for (const ConnectionCounter& counter : kConnectionCounters) {
    json.member(counter.name, connection.*counter.value);
  }
  json.end_object();
  return {};
}

http::Response answer_of(int status, std::string body) {
  return http::Response(status, "application/json", std::move(body))
      .with("Cache-Control", "no-store");
}

Result<http::Response> list(const Connections& all) {
  std::string body;
  JsonWriter json(body);
  json.begin_object().key("connections").begin_array();
  for (const ConnectionState& connection : all.states())
    TRY(write_connection(json, connection, all.now()));
  json.end_array().end_object();
  return answer_of(200, std::move(body));
}

std::string name_of(const http::Request& request) { return std::string(*request.text("name")); }

Error unknown(const std::string& name) {
  return {ErrorCode::ConnectionUnknown, "connection not found: '" + name + "'"};
}

Result<http::Response> one(const Connections& all, const std::string& name, int status) {
  const auto state = all.state(name);
  if (!state) return unknown(name);
  std::string body;
  JsonWriter json(body);
  TRY(write_connection(json, *state, all.now()));
  return answer_of(status, std::move(body));
}

using Change = Result<http::Response> (*)(Connections&, const http::Request&);

/// A handler that responds with the result of `change` on the thread of changes, or of tests.
http::AsyncHandler by(Connections& all, Change change, bool is_test = false) {
  return [&all, change, is_test](const http::Request& request, http::Responder responder) {
    const auto shared = api::share(std::move(responder));
    const bool is_taken = all.run(
        [&all, &request, change, answer = api::answer_by(shared)] { answer(change(all, request)); },
        is_test);
    if (is_taken) return;
    shared->fail({ErrorCode::StorageBusy, "too many changes of connections wait: try again soon"});
  };
}

Result<http::Response> put(Connections& all, const http::Request& request) {
  const auto is_new = TRY(all.put(name_of(request), request.body(), api::caller_text(request)));
  return one(all, name_of(request), is_new ? 201 : 200);
}

Result<http::Response> remove(Connections& all, const http::Request& request) {
  TRY(all.remove(name_of(request), api::caller_text(request)));
  return http::Response(204);
}

Result<http::Response> test(Connections& all, const http::Request& request) {
  const auto found = TRY(all.test(name_of(request)));
  std::string body;
  JsonWriter(body)
      .begin_object()
      .member("ok", found.ok)
      .member("detail", found.detail)
      .end_object();
  return answer_of(200, std::move(body));
}

Result<http::Response> replay(Connections& all, const http::Request& request) {
  TRY(all.replay(name_of(request), request.body()));
  return one(all, name_of(request), 200);
}

}  // namespace

void add_connections_routes(api::Routes& add, Connections& all) {
  const http::Parameter name = api::path_parameter("name", "1 to 63 letters, digits, - and _");
  add("GET /v1/connections listConnections viewer",
      [&all](const http::Request&) { return list(all); },
      {.summary = "The connections: state, lag, last error and counts",
       .outcomes = {{.meaning = "Sorted by name", .schema = "Connections"}}});
  add("GET /v1/connections/{name} getConnection viewer",
      [&all](const http::Request& request) { return one(all, name_of(request), 200); },
      {.summary = "A connection: its settings without secrets, and its state",
       .parameters = {name},
       .outcomes = {{.meaning = "State of the connection", .schema = "Connection"}},
       .refusals = {404}});
  add("PUT /v1/connections/{name} putConnection admin", by(all, put),
      {.summary = "Store a connection and start it",
       .description = "A connection of the configuration file gives 409 `connection.read_only`.",
       .parameters = {name},
       .body = api::json_body("ConnectionOrder"),
       .outcomes = {{.meaning = "The connection is replaced and continues at its position",
                     .schema = "Connection"},
                    {.status = 201, .meaning = "Created", .schema = "Connection"}},
       .refusals = {409}});
  add("DELETE /v1/connections/{name} deleteConnection admin", by(all, remove),
      {.summary = "Delete a connection and its position",
       .parameters = {name},
       .outcomes = {{.status = 204, .meaning = "Deleted"}},
       .refusals = {404, 409}});
  add("POST /v1/connections/{name}/test testConnection admin", by(all, test, true),
      {.summary = "Test a connection once",
       .description = "Answers 200 for every result of the test, after at most half a minute.",
       .parameters = {name},
       .outcomes = {{.meaning = "Result", .schema = "ConnectionTest"}},
       .refusals = {404}});
  add("POST /v1/connections/{name}/replay replayConnection admin", by(all, replay),
      {.summary = "Send again from a place",
       .description = "Events go out again with their ids: a receiver that knows them by "
                      "their ids ignores what it has.",
       .parameters = {name},
       .body = api::json_body("ConnectionReplay"),
       .outcomes = {{.meaning = "The connection sends again", .schema = "Connection"}},
       .refusals = {404}});
}

}  // namespace fitgauge::connections

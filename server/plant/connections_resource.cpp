#include "api/wire/request_facts.hpp"
#include "plant/connections.hpp"

namespace fitgauge::connections {
void members(auto& v, const DeadLetter& letter) {
  v.member("measurement", letter.measurement, "Id of the measurement");
  v.member("at", letter.at, api::Time{}, "Time of the refusal");
  v.member("reason", letter.reason, "Answer of the other side");
}

void members(auto& v, const ConnectionTest& test) {
  v.member("ok", test.ok, "The other side was reached");
  v.member("detail", test.detail, "Result");
}

namespace {

using api::JsonWriter;

namespace schema = api::schema;
using schema::Others;

/// A text that is one of these words.
struct WordOf {
  std::vector<std::string_view> words;

  std::string schema(api::Side) const { return schema::words(words); }
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};

struct Seconds {
  std::string schema(api::Side) const { return schema::number(); }
  void write(JsonWriter& json, double from) const { json.fixed(from, 3); }
};

/// Returns the place of the connection's state in the list of words of `state`.
int state_of(const ConnectionState& connection) {
  if (connection.is_stopped) return 4;
  if (hangs(connection, std::chrono::steady_clock::now())) return 3;
  if (connection.is_failing) return 2;
  return connection.last_success_at ? 1 : 0;
}

std::optional<std::string> text_of(const std::optional<Timestamp>& time) {
  return time ? std::optional(format_rfc3339(*time)) : std::nullopt;
}

std::optional<double> lag_of(const ConnectionState& connection, Timestamp now) {
  const auto nanoseconds = lag(connection, now);
  return nanoseconds ? std::optional(static_cast<double>(*nanoseconds) / 1e9) : std::nullopt;
}

std::vector<std::string_view> names_of_kinds() {
  std::vector<std::string_view> names;
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  return names;
}

void identity_members(auto& v, const ConnectionState& connection) {
  v.member("name", connection.name);
  v.member("kind", connection.kind, WordOf{names_of_kinds()});
  v.member("direction", connection.is_outgoing, Choice{"in", "out"});
  v.member("read_only", connection.is_read_only,
           "The connection belongs to the configuration file");
}

void state_members(auto& v, const ConnectionState& connection, Timestamp now) {
  v.member("state", state_of(connection), Choice{"waiting", "ok", "failing", "hanging", "stopped"},
           "State of the last attempt; hanging: the current attempt has made no progress for a "
           "minute; stopped: the other side accepts no more");
  v.member("last_attempt_at", text_of(connection.last_attempt_at));
  v.member("last_success_at", text_of(connection.last_success_at),
           "Time of the last delivery or storage");
  v.member("attempt_began_at", text_of(connection.attempt_began_at),
           "Start of the current attempt");
  v.member("lag_s", lag_of(connection, now), Seconds{},
           "Time since the last success; outgoing: age of the next measurement");
  v.member("last_error",
           connection.last_error.empty() ? std::nullopt : std::optional(connection.last_error),
           "Error of the last failed attempt");
  const auto if_outgoing = [&](const auto& value) {
    return connection.is_outgoing ? std::optional(value) : std::nullopt;
  };
  v.optional("position", if_outgoing(connection.position.value_or(0)),
             "Outgoing: measurements of the log that are done");
  v.optional("behind", if_outgoing(connection.behind),
             "Outgoing: measurements of the log that wait");
  v.optional("dead_letters", if_outgoing(connection.dead_letters),
             "Outgoing: finally refused measurements, newest first");
  for (const ConnectionCounter& counter : kConnectionCounters) {
    v.member(counter.name, connection.*counter.value, counter.meaning);
  }
}

Result<void> write_connection(JsonWriter& json, const ConnectionState& connection, Timestamp now) {
  const auto settings = TRY(parse_stored_json(connection.settings, "a connection"));
  json.begin_object();
  api::BodyWriter write(json);
  identity_members(write, connection);
  for (const auto& [name, value] : settings.members) {
    if (name != "kind") write_json(json.key(name), value);
  }
  state_members(write, connection, now);
  json.end_object();
  return {};
}

/// Returns the name of the schema of a kind: FolderInConnection for `folder_in`.
std::string component_of(std::string_view kind) {
  std::string component;
  for (std::size_t i = 0; i < kind.size(); ++i) {
    const bool begins = i == 0 || kind[i - 1] == '_';
    if (kind[i] != '_') component += begins ? ascii_upper(kind[i]) : kind[i];
  }
  return component + "Connection";
}

/// The settings of all kinds, each once, without secrets.
schema::Fields shown_settings() {
  schema::Fields all;
  for (const Kind& kind : kinds()) {
    for (schema::Field& field : kind.fields()) {
      const bool is_known = std::ranges::find(all, field.name, &schema::Field::name) != all.end();
      if (!is_known && !is_secret(field.name)) all.push_back(std::move(field));
    }
  }
  return schema::optional(std::move(all));
}

schema::Fields fields_of(const auto& describe_members) {
  api::BodySchema describe(api::Side::Answer);
  describe_members(describe);
  return describe.fields();
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
  return answer_of(200, api::body_json(found));
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

void add_connection_schemas(api::Schemas& schemas) {
  std::vector<std::pair<std::string_view, std::string>> orders;
  for (const Kind& kind : kinds()) {
    orders.emplace_back(kind.name, component_of(kind.name));
    schemas.push_back(
        {orders.back().second,
         schema::object(schema::Fields{{"kind", schema::words({kind.name}), ""}} + kind.fields(),
                        Others::Refused)});
  }
  schemas.push_back({"ConnectionOrder", schema::one_of("kind", orders)});
  schemas.push_back(
      {"Connection",
       schema::object(fields_of([](auto& v) { identity_members(v, {}); }) + shown_settings() +
                      schema::Fields{{"secret_count", schema::count(), "Number of secrets", false},
                                     {"password_set", schema::boolean(),
                                      "true if a password is stored", false}} +
                      fields_of([](auto& v) { state_members(v, {}, {}); }))});
  schemas.push_back(
      {"Connections",
       schema::object({{"connections", schema::array(schema::ref("Connection")), ""}})});
  schemas.push_back(api::order_schema<ReplayOrder>("ConnectionReplay"));
  schemas.push_back(api::answer_schema<ConnectionTest>("ConnectionTest"));
}

}  // namespace fitgauge::connections

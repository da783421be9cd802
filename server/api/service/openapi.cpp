#include "api/resources.hpp"

#include "base/gzip.hpp"
#include "base/json/json_writer.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

std::string schema_of(const http::ParameterType& type) {
  return std::visit(
      Overloaded{
          [](const http::Text& text) {
            return text.schema.empty() ? schema::text(text.max_length) : std::string(text.schema);
          },
          [](const http::Integer& integer) { return schema::integer(integer.min, integer.max); },
          [](const http::Decimal& decimal) {
            return json_object([&](JsonWriter& json) {
              json.member("type", "number").key("minimum").decimal(decimal.min, decimal.scale);
              json.key("maximum").decimal(decimal.max, decimal.scale);
            });
          },
          // The number may also be a text, so that no double comes between, as in a body.
          [](const http::LengthIn&) { return std::string(R"({"type":["number","string"]})"); },
          [](const http::Words& words) {
            return schema::words({words.words.begin(), words.words.end()});
          },
          [](const http::Time&) { return schema::time(); },
      },
      type);
}

std::string_view place(http::ParameterPlace place) {
  return word_of(place, {"path", "query", "header"});
}

/// The example of a body: of JSON that of its schema, of others a text.
std::string example_of(std::string_view type, const std::string& schema, const Schemas& schemas) {
  if (type == "text/csv")
    return json_string("designation,measured_mm,part_id\n25 H7,25.013,SN-1\n");
  if (type == "application/octet-stream")
    return json_string("BEGIN PGM BORE MM\nEND PGM BORE MM\n");
  const auto named = std::ranges::find(schemas, schema, &NamedSchema::name);
  if (named == schemas.end()) return {};
  if (type == "application/x-ndjson") return json_string(named->example + '\n');
  return type == "application/json" ? named->example : "";
}

/// The JSON form has the named schema, as has the data of each event; any other is text or bytes.
/// @param schemas of examples; null: without
void write_content(JsonWriter& json, const std::vector<std::string>& media_types,
                   const std::string& schema, const Schemas* schemas = nullptr) {
  json.key("content").begin_object();
  for (const std::string& type : media_types) {
    const bool described =
        !schema.empty() && (type == "application/json" || type == "text/event-stream");
    json.key(type).begin_object().key("schema").raw(described ? schema::ref(schema)
                                                              : schema::text());
    const std::string example = schemas == nullptr ? "" : example_of(type, schema, *schemas);
    if (!example.empty()) json.key("example").raw(example);
    json.end_object();
  }
  json.end_object();
}

void write_request_body(JsonWriter& json, const http::BodyRules& body, const Schemas& schemas) {
  if (body.use == http::BodyUse::None) return;
  const std::vector<std::string> any{"application/octet-stream"};
  json.key("requestBody").begin_object().member("required", body.use == http::BodyUse::Required);
  write_content(json, body.media_types.empty() ? any : body.media_types, body.schema, &schemas);
  json.end_object();
}

bool has_json_body(const http::Route& route) {
  const auto& types = route.body.media_types;
  return std::ranges::find(types, "application/json") != types.end();
}

/// A length that is too fine or out of range is 422, in a query as in a body.
bool takes_length(const http::Route& route) {
  return std::ranges::any_of(route.parameters, [](const auto& parameter) {
    return std::holds_alternative<http::LengthIn>(parameter.type);
  });
}

/// Returns the refusals of the route and of all routes of its kind.
std::set<int> refusals_of(const http::Route& route) {
  std::set<int> found(route.refusals.begin(), route.refusals.end());
  found.insert({405, 417});  // of its path, and of any request
  const bool takes_body = route.body.use != http::BodyUse::None;
  if (!route.parameters.empty() || takes_body) found.insert(400);
  if (route.access != "public") found.insert({401, 403});
  if (!route.response_types.empty()) found.insert(406);
  if (takes_body) found.insert({411, 413, 415});
  if (has_json_body(route) || takes_length(route)) found.insert(422);
  if (route.pattern.starts_with("/v1/")) found.insert(503);
  return found;
}

bool takes(const http::Route& route, std::string_view parameter) {
  return std::ranges::any_of(route.parameters,
                             [&](const auto& known) { return known.name == parameter; });
}
bool is_get(const http::Route& route) { return route.method == http::Method::Get; }
bool has_tag(const http::Route& route) {
  const bool is_of_tables = route.tag == "limits" || route.tag == "tables";
  const bool is_page = route.pattern == "/" || route.pattern.starts_with("/web/");
  return takes(route, "If-Match") || (is_get(route) && (is_of_tables || is_page));
}

/// Headers of a success, each with the routes that have it.
struct DescribedHeader {
  std::string_view name;
  std::string_view meaning;
  bool (*is_of)(const http::Route&, int status);
};
constexpr DescribedHeader kHeaders[] = {
    {"X-Request-Id", "The caller's own, or one that was made; the log has it",
     [](const auto&, int) { return true; }},
    {"ETag", "Names the state, for If-Match and If-None-Match",
     [](const auto& route, int) { return has_tag(route); }},
    {"Location", "The address of what is new",
     [](const auto& route, int status) {
       const bool is_once = takes(route, "Idempotency-Key") && !route.pattern.ends_with("/notes");
       const bool is_file =
           route.method == http::Method::Put && route.pattern.starts_with("/v1/files");
       return is_file || (is_once && (status == 201 || status == 202));
     }},
    {"Idempotency-Replayed", "true: the response to an earlier request with this key",
     [](const auto& route, int) { return takes(route, "Idempotency-Key"); }},
    {"Preference-Applied", "The word of Prefer that was applied",
     [](const auto& route, int) { return takes(route, "Prefer"); }},
    {"Link", "The next page, rel=\"next\"",
     [](const auto& route, int status) {
       return status == 200 && is_get(route) && takes(route, "after") && takes(route, "limit");
     }},
    {"Content-Disposition", "The name of the file",
     [](const auto& route, int status) {
       return status == 200 && is_get(route) &&
              (route.pattern == "/v1/measurements" || route.pattern == "/v1/certificates");
     }},
};

void write_headers(JsonWriter& json, const http::Route& route, int status) {
  json.key("headers").begin_object();
  for (const DescribedHeader& header : kHeaders) {
    if (!header.is_of(route, status)) continue;
    json.key(header.name).begin_object().member("description", header.meaning);
    json.key("schema").raw(schema::text()).end_object();
  }
  json.end_object();
}

void write_outcome(JsonWriter& json, const http::Route& route, const http::Outcome& outcome) {
  json.key(std::to_string(outcome.status)).begin_object().member("description", outcome.meaning);
  write_headers(json, route, outcome.status);
  const auto& types = outcome.media_types.empty() ? route.response_types : outcome.media_types;
  const bool has_body = !outcome.schema.empty() || !outcome.media_types.empty() ||
                        (outcome.status == 200 && types.front() != "application/json");
  if (has_body) write_content(json, types, outcome.schema);
  json.end_object();
}

void write_responses(JsonWriter& json, const http::Route& route) {
  const std::string components = "#/components/responses/";
  const bool is_mtconnect = route.pattern.starts_with("/mtconnect/");
  const auto refusal = [&](int status) {
    if (is_mtconnect) return components + "MtconnectError";
    if (status == 405) return components + "OtherMethod";
    return components + (status == 401 ? "KeyNeeded" : status == 503 ? "Unavailable" : "Problem");
  };
  json.key("responses").begin_object();
  for (const http::Outcome& outcome : route.outcomes) write_outcome(json, route, outcome);
  if (is_get(route) && has_tag(route)) {
    json.key("304").begin_object().member("description", "If-None-Match names the state");
    write_headers(json, route, 304);
    json.end_object();
  }
  for (const int status : refusals_of(route))
    json.key(std::to_string(status)).begin_object().member("$ref", refusal(status)).end_object();
  json.key("default").begin_object().member("$ref", refusal(0)).end_object().end_object();
}

/// The role that a key needs; `open` needs one only if the service requires keys for everything.
void write_security(JsonWriter& json, const std::string& access) {
  json.key("security").begin_array();
  const bool needs_none = access == "public" || access == "open";
  if (needs_none) json.begin_object().end_object();
  for (const std::string_view scheme : {"key", "header"}) {
    if (access == "public") break;
    json.begin_object().key(scheme).begin_array();
    json.value(needs_none ? "viewer" : access).end_array().end_object();
  }
  json.end_array();
}

void write_operation(JsonWriter& json, const http::Route& route, const Schemas& schemas) {
  json.key(ascii_lower(http::name(route.method)))
      .begin_object()
      .member("operationId", route.operation)
      .list("tags", std::array{route.tag})
      .member("summary", route.summary);
  json.member("description", route.description.empty() ? route.summary : route.description);
  if (!route.parameters.empty()) {
    json.list("parameters", route.parameters, [&json](const Parameter& parameter) {
      json.begin_object()
          .member("name", parameter.name)
          .member("in", place(parameter.place))
          .member("required", parameter.required || parameter.place == http::ParameterPlace::Path)
          .member("description", parameter.description);
      json.key("schema").raw(schema_of(parameter.type)).end_object();
    });
  }
  write_request_body(json, route.body, schemas);
  write_responses(json, route);
  write_security(json, route.access);
  json.end_object();
}

/// `{path*}` is the rest of the path, which OpenAPI cannot express: it is written as `{path}`.
std::string openapi_path(std::string pattern) {
  if (const std::size_t star = pattern.find("*}"); star != std::string::npos)
    pattern.erase(star, 1);
  return pattern;
}

constexpr std::string_view kSecurity =
    R"({"key":{"type":"http","scheme":"bearer","description":"Key of fitgauged key create"},)"
    R"("header":{"type":"apiKey","in":"header","name":"X-API-Key","description":"Key of fitgauged key create"}})";
/// The groups of operations, in the order of a first reading.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kTags = {{
    {"limits", "Limits of size, fits and verdicts (ISO 286-1)"},
    {"statistics", "The figures of a quality engineer, each with its source"},
    {"tables", "The tolerance tables and custom tolerance classes"},
    {"measurements", "Judged measurements, stored for good"},
    {"log", "Signed proof of what was stored"},
    {"plans", "The characteristics of a part, in the order of measuring"},
    {"files", "The control's disk: programs, masks and tables"},
    {"setups", "Machines with their workpieces"},
    {"runs", "Programs on a simulated machine"},
    {"cycles", "The touch-probe cycles"},
    {"connections", "Controls, folders and receivers outside, and how each does"},
    {"service", "Health, events, metrics, this description and the page"},
}};

void write_info(JsonWriter& json) {
  json.key("info").begin_object();
  json.member("title", "fitgauge").member("version", kVersion);
  json.member("description",
              "ISO 286 limits and fits, verdicts on measured diameters, Klartext probe programs on "
              "a simulated machine. Lengths are exact decimals.");
  json.key("contact").begin_object().member("name", "fitgauge").end_object();
  json.key("license").begin_object().member("name", "Apache License 2.0");
  json.member("identifier", "Apache-2.0").end_object().end_object();
  json.key("servers").begin_array().begin_object().member("url", "/");
  json.member("description", "The service that sent this response").end_object().end_array();
  json.list("tags", kTags, [&json](const auto& tag) {
    json.begin_object().member("name", tag.first).member("description", tag.second).end_object();
  });
}

/// The answer of a refusal, with a header of its status.
std::string refusal_response(std::string_view name, std::string_view type, std::string_view schema,
                             std::string_view header = {}) {
  std::string headers = R"("X-Request-Id":{"$ref":"#/components/headers/X-Request-Id"})";
  if (!header.empty()) headers += fmt::format(R"(,"{}":{{"schema":{}}})", header, schema::text());
  return fmt::format(
      R"("{}":{{"description":"The fault","headers":{{{}}},"content":{{"{}":{{"schema":{}}}}}}})",
      name, headers, type, schema);
}

void write_components(JsonWriter& json, const Schemas& schemas) {
  json.key("components").begin_object().key("securitySchemes").raw(kSecurity);
  constexpr std::string_view kProblem = "application/problem+json";
  const std::string problem = schema::ref("Problem");
  json.key("headers").raw(fmt::format(R"({{"X-Request-Id":{{"description":"{}","schema":{}}}}})",
                                      kHeaders[0].meaning, schema::text()));
  json.key("responses")
      .raw(fmt::format("{{{},{},{},{},{}}}", refusal_response("Problem", kProblem, problem),
                       refusal_response("KeyNeeded", kProblem, problem, "WWW-Authenticate"),
                       refusal_response("Unavailable", kProblem, problem, "Retry-After"),
                       refusal_response("OtherMethod", kProblem, problem, "Allow"),
                       refusal_response("MtconnectError", "text/xml", schema::text(), "Allow")));
  json.key("schemas").begin_object();
  for (const NamedSchema& schema : schemas) json.key(schema.name).raw(schema.json);
  json.end_object().end_object();
}

}  // namespace

Schemas make_schemas(const Schemas& of_plant) {
  Schemas schemas;
  for (AddSchemas* const add :
       {add_limits_schemas, add_statistics_schemas, add_table_schemas, add_measurement_schemas,
        add_note_schemas, add_plan_schemas, add_parts_schemas, add_file_schemas, add_setup_schemas,
        add_run_schemas, add_cycle_schemas})
    add(schemas);
  schemas.insert(schemas.end(), of_plant.begin(), of_plant.end());
  add_service_schemas(schemas);
  add_examples(schemas);
  return schemas;
}

std::string openapi_json(const std::vector<http::Route>& routes, const Schemas& of_plant) {
  std::map<std::string, std::vector<const http::Route*>> paths;
  const Schemas schemas = make_schemas(of_plant);
  for (const http::Route& route : routes) paths[openapi_path(route.pattern)].push_back(&route);
  return json_object([&](JsonWriter& json) {
    json.member("openapi", "3.1.0");
    write_info(json);
    json.key("paths").begin_object();
    for (const auto& [path, operations] : paths) {
      json.key(path).begin_object();
      for (const http::Route* route : operations) write_operation(json, *route, schemas);
      json.end_object();
    }
    json.end_object();
    write_components(json, schemas);
  });
}

void add_openapi_route(Routes& add, const Schemas& of_plant) {
  add("GET /openapi.json getOpenapi open", http::SyncHandler{},
      {.summary = "This description",
       .tag = "service",
       .outcomes = {{.meaning = "OpenAPI 3.1", .schema = "Description"}},
       .refusals = {503}});
  // Written for the first that asks, by a worker: it takes an eighth of a start.
  struct Description {
    std::vector<http::Route> routes;
    Schemas of_plant;
    std::once_flag once{};
    std::shared_ptr<const http::PreparedResponse> document{};
  };
  const auto answer = [made = std::make_shared<Description>(add.all, of_plant)]() {
    std::call_once(made->once, [&made] {
      const auto text = openapi_json(made->routes, made->of_plant);
      made->document = http::prepare({200, "application/json", text}, gzip(text));
      made->routes = {};
      made->of_plant = {};
    });
    return Result<Response>(Response(made->document));
  };
  add.all.back().handler = [answer, &jobs = add.services.jobs](const Request&, Responder to) {
    jobs.orders.run(answer, answer_by(share(std::move(to))));
  };
}

}  // namespace fitgauge::api

#include "api/service/openapi.hpp"

#include <map>

#include "api/service/version.hpp"
#include "api/wire/json_writer.hpp"
#include "base/decimal.hpp"
#include "base/text.hpp"

namespace fitgauge::api {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

void write_schema(JsonWriter& json, const http::ParameterType& type) {
  json.key("schema").begin_object();
  std::visit(
      Overloaded{
          [&](const http::Text& text) {
            json.member("type", "string").member("maxLength", std::uint64_t{text.max_length});
          },
          [&](const http::Integer& integer) {
            json.member("type", "integer")
                .member("minimum", integer.min)
                .member("maximum", integer.max);
          },
          [&](const http::Decimal& decimal) {
            json.member("type", "number")
                .key("minimum")
                .decimal(decimal.min, decimal.scale)
                .key("maximum")
                .decimal(decimal.max, decimal.scale);
          },
          [&](const http::LengthIn&) { json.member("type", "number"); },
          [&](const http::Words& words) {
            json.member("type", "string").key("enum").begin_array();
            for (const std::string& word : words.words) json.value(word);
            json.end_array();
          },
          [&](const http::Boolean&) { json.member("type", "boolean"); },
          [&](const http::Time&) { json.member("type", "string").member("format", "date-time"); },
      },
      type);
  json.end_object();
}

std::string_view place(http::ParameterPlace place) {
  switch (place) {
    case http::ParameterPlace::Path: return "path";
    case http::ParameterPlace::Query: return "query";
    case http::ParameterPlace::Header: return "header";
  }
  return "";
}

void write_content(JsonWriter& json, const std::vector<std::string>& media_types) {
  json.key("content").begin_object();
  for (const std::string& type : media_types) {
    json.key(type).begin_object().key("schema").begin_object();
    if (type != "application/json") json.member("type", "string");
    json.end_object().end_object();
  }
  json.end_object();
}

void write_request_body(JsonWriter& json, const http::BodyRules& body) {
  if (body.use == http::BodyUse::None) return;
  const std::vector<std::string> any{"application/octet-stream"};
  json.key("requestBody").begin_object().member("required", body.use == http::BodyUse::Required);
  write_content(json, body.media_types.empty() ? any : body.media_types);
  json.end_object();
}

void write_responses(JsonWriter& json, const http::Route& route) {
  json.key("responses").begin_object().key("2XX").begin_object().member("description", "Success");
  if (!route.response_types.empty() && route.method != http::Method::Delete) {
    write_content(json, route.response_types);
  }
  json.end_object()
      .key("default")
      .begin_object()
      .member("$ref", "#/components/responses/Problem")
      .end_object()
      .end_object();
}

void write_operation(JsonWriter& json, const http::Route& route) {
  json.key(ascii_lower(http::name(route.method))).begin_object().member("summary", route.summary);
  if (!route.description.empty()) json.member("description", route.description);
  if (!route.parameters.empty()) {
    json.key("parameters").begin_array();
    for (const http::Parameter& parameter : route.parameters) {
      json.begin_object()
          .member("name", parameter.name)
          .member("in", place(parameter.place))
          .member("required", parameter.required || parameter.place == http::ParameterPlace::Path)
          .member("description", parameter.description);
      write_schema(json, parameter.type);
      json.end_object();
    }
    json.end_array();
  }
  write_request_body(json, route.body);
  write_responses(json, route);
  json.key("security").begin_array();
  if (route.access == "public" || route.access == "open") json.begin_object().end_object();
  json.begin_object().key("key").begin_array().end_array().end_object();
  json.end_array().end_object();
}

/// `{path*}` takes the rest of the path, which OpenAPI cannot say: it stands as `{path}`.
std::string openapi_path(std::string pattern) {
  if (const std::size_t star = pattern.find("*}"); star != std::string::npos)
    pattern.erase(star, 1);
  return pattern;
}

constexpr std::string_view kComponents = R"json({
"securitySchemes": {"key": {"type": "http", "scheme": "bearer"}},
"responses": {"Problem": {
  "description": "What is wrong (RFC 9457)",
  "content": {"application/problem+json": {"schema": {"$ref": "#/components/schemas/Problem"}}}}},
"schemas": {"Problem": {
  "type": "object",
  "required": ["type", "title", "status", "detail", "code"],
  "properties": {
    "type": {"type": "string"}, "title": {"type": "string"}, "status": {"type": "integer"},
    "detail": {"type": "string"}, "instance": {"type": "string"}, "code": {"type": "string"},
    "errors": {"type": "array", "items": {"type": "object", "properties": {
      "pointer": {"type": "string"}, "line": {"type": "integer"},
      "code": {"type": "string"}, "detail": {"type": "string"}}}}}}}})json";

}  // namespace

std::string openapi_json(const std::vector<http::Route>& routes) {
  std::map<std::string, std::vector<const http::Route*>> paths;
  for (const http::Route& route : routes) paths[openapi_path(route.pattern)].push_back(&route);
  std::string out;
  JsonWriter json(out);
  json.begin_object()
      .member("openapi", "3.1.0")
      .key("info")
      .begin_object()
      .member("title", "fitgauge")
      .member("version", kVersion)
      .member("description",
              "ISO 286 limits and fits, verdicts on measured diameters, Klartext probe programs on "
              "a simulated machine. Lengths are exact decimals.")
      .end_object()
      .key("paths")
      .begin_object();
  for (const auto& [path, operations] : paths) {
    json.key(path).begin_object();
    for (const http::Route* route : operations) write_operation(json, *route);
    json.end_object();
  }
  json.end_object().key("components").raw(kComponents).end_object();
  return out;
}

void add_openapi_route(std::vector<http::Route>& routes) {
  routes.push_back({.pattern = "/openapi.json",
                    .handler = http::SyncHandler{},
                    .summary = "This description",
                    .access = "open"});
  const auto document = http::prepare({200, "application/json", openapi_json(routes)});
  routes.back().handler = [document](const http::Request&) -> Result<http::Response> {
    return http::Response(document);
  };
}

}  // namespace fitgauge::api

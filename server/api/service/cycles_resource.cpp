#include "api/resources.hpp"

#include <cmath>

#include "base/json/json_writer.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/program/machining_cycles.hpp"

namespace fitgauge::api {
namespace {

using probing::CycleDescriptor;
using probing::CycleFamily;
using probing::CycleParameter;
using probing::ValueKind;

std::string_view word(CycleFamily family) {
  return family == CycleFamily::TchProbe ? "TCH PROBE" : "CYCL DEF";
}

std::string_view word(ValueKind kind) {
  switch (kind) {
    case ValueKind::Number: return "number";
    case ValueKind::Whole: return "whole";
    case ValueKind::NumberOrMax: return "number or MAX";
    case ValueKind::Text: return "text";
    case ValueKind::NumberOrText: return "number or text";
  }
  return "";
}

/// null where there is no end.
void write_end(JsonWriter& json, std::string_view name, double value) {
  json.key(name);
  if (std::isfinite(value)) {
    json.value(value);
  } else {
    json.null();
  }
}

void write_default(JsonWriter& json, const std::optional<double>& value) {
  if (!value) return;
  json.key("default");
  if (std::isinf(*value)) {
    json.value("MAX");
  } else {
    json.value(*value);
  }
}

void write_parameter(JsonWriter& json, const CycleParameter& parameter) {
  json.begin_object()
      .member("name", name(parameter))
      .member("meaning", parameter.meaning)
      .member("unit", symbol(parameter.unit))
      .member("kind", word(parameter.kind))
      .member("required", parameter.required && !parameter.default_value);
  if (!parameter.is_text()) {
    json.key("range").begin_object();
    write_end(json, "min", parameter.range.min);
    write_end(json, "max", parameter.range.max);
    json.end_object();
  }
  write_default(json, parameter.default_value);
  json.end_object();
}

void write_head(JsonWriter& json, const CycleDescriptor& cycle) {
  json.begin_object()
      .member("number", std::uint32_t{cycle.number})
      .member("name", cycle.name)
      .member("family", word(cycle.family))
      .member("kind", word(cycle.kind));
}

void write_cycle(JsonWriter& json, const CycleDescriptor& cycle) {
  write_head(json, cycle);
  json.key("parameters").begin_array();
  for (const CycleParameter& parameter : cycle.parameters) write_parameter(json, parameter);
  json.end_array().key("results").begin_array();
  for (const probing::CycleOutput& result : cycle.results) {
    json.begin_object()
        .member("name", "Q" + std::to_string(result.q))
        .member("meaning", result.meaning)
        .member("unit", symbol(result.unit))
        .end_object();
  }
  json.end_array().member("simulated", cycle.simulated);
  json.member("not_simulated", cycle.not_simulated).end_object();
}

http::Response list_cycles() {
  std::string body;
  JsonWriter json(body);
  json.begin_object().key("cycles").begin_array();
  for (const probing::TouchProbeCycle* cycle : probing::cycles()) {
    write_cycle(json, cycle->descriptor);
  }
  for (const interpreter::MachiningCycle& cycle : interpreter::machining_cycles()) {
    write_cycle(json, cycle.descriptor);
  }
  json.end_array().end_object();
  return {200, "application/json", std::move(body)};
}

const CycleDescriptor* find_descriptor(int number) {
  for (const CycleFamily family : {CycleFamily::TchProbe, CycleFamily::CyclDef}) {
    const probing::TouchProbeCycle* cycle = probing::find_cycle(family, number);
    if (cycle != nullptr) return &cycle->descriptor;
  }
  const interpreter::MachiningCycle* machining = interpreter::machining_cycle(number);
  return machining == nullptr ? nullptr : &machining->descriptor;
}

/// A number may mean two cycles; the one for probing goes first.
Result<http::Response> find_cycle(const http::Request& request) {
  const int number = static_cast<int>(*request.integer("number"));
  const CycleDescriptor* cycle = find_descriptor(number);
  if (cycle == nullptr) {
    return Error{ErrorCode::CycleUnknown,
                 "there is no cycle " + std::to_string(number) + "; /v1/cycles lists all"};
  }
  std::string body;
  JsonWriter json(body);
  write_cycle(json, *cycle);
  return http::Response(200, "application/json", std::move(body));
}

}  // namespace

void add_cycles_routes(std::vector<http::Route>& routes) {
  routes.push_back({
      .pattern = "/v1/cycles",
      .handler = [answer = http::prepare(list_cycles())](
                     const http::Request&) -> Result<http::Response> { return answer; },
      .summary = "Every cycle with its parameters and results",
      .access = "open",
      .operation = "listCycles",
      .tag = "cycles",
      .outcomes = {{.meaning = "All of them", .schema = "Cycles"}},
  });
  routes.push_back({
      .pattern = "/v1/cycles/{number}",
      .handler = find_cycle,
      .summary = "One cycle; a number of both kinds is the touch-probe cycle",
      .parameters = {{.name = "number",
                      .place = http::ParameterPlace::Path,
                      .type = http::Integer{.min = 0, .max = 9999},
                      .description = "421"}},
      .access = "open",
      .operation = "getCycle",
      .tag = "cycles",
      .outcomes = {{.meaning = "The cycle", .schema = "Cycle"}},
      .refusals = {404},
  });
}

}  // namespace fitgauge::api

#include "api/resources.hpp"

#include "base/json/body_forms.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/program/cycles.hpp"

namespace fitgauge::api {

using probing::CycleDescriptor;
using probing::CycleFamily;
using probing::CycleParameter;

/// A number, or MAX for one without end.
struct NumberOrMax {
  std::string schema(Side) const { return R"({"type":["number","string"]})"; }
  void write(JsonWriter& json, double from) const {
    std::isinf(from) ? json.value("MAX") : json.value(from);
  }
};

void members(auto& v, const probing::ValueRange& range) {
  v.member("min", range.min);
  v.member("max", range.max, "Upper bound; null: none");
}

void members(auto& v, const CycleParameter& parameter) {
  constexpr OneOf<5> kKinds{"number", "whole", "number or MAX", "text", "number or text"};
  v.member("name", name(parameter), "Q261, or its place in a cycle without names");
  v.member("meaning", parameter.meaning);
  v.member("unit", symbol(parameter.unit));
  v.member("kind", parameter.kind, kKinds);
  v.member("required", parameter.required && !parameter.default_value);
  v.optional("range", parameter.is_text() ? nullptr : &parameter.range, "Range of a number");
  v.optional("default", parameter.default_value, NumberOrMax{}, "A number, or MAX");
}

void members(auto& v, const probing::CycleOutput& result) {
  v.member("name", "Q" + std::to_string(result.q), "Q153");
  v.member("meaning", result.meaning);
  v.member("unit", symbol(result.unit));
}

void members(auto& v, const CycleDescriptor& cycle) {
  v.member("number", cycle.number);
  v.member("name", cycle.name, "Name on the control");
  v.member("family", cycle.family, OneOf<2>{"CYCL DEF", "TCH PROBE"});
  v.member("kind", word(cycle.kind), "Purpose of the cycle");
  v.member("parameters", cycle.parameters, List<CycleParameter>{});
  v.member("results", cycle.results, List<probing::CycleOutput>{}, "Results in Q parameters");
  v.member("simulated", cycle.simulated, "The effect in the simulation");
  v.member("not_simulated", cycle.not_simulated, "Parameters without effect in the simulation");
}

struct CyclesAnswer {
  std::vector<CycleDescriptor> cycles{};
};
void members(auto& v, const CyclesAnswer& answer) {
  v.member("cycles", answer.cycles, List<CycleDescriptor>{{"Cycle"}});
}

namespace {

Response list_cycles() {
  CyclesAnswer answer;
  for (const auto* cycle : probing::cycles()) answer.cycles.push_back(cycle->descriptor);
  for (const auto& cycle : interpreter::machining_cycles())
    answer.cycles.push_back(cycle.descriptor);
  return {200, "application/json", body_json(answer)};
}

const CycleDescriptor* find_descriptor(int number) {
  for (const CycleFamily family : {CycleFamily::TchProbe, CycleFamily::CyclDef}) {
    const probing::TouchProbeCycle* cycle = probing::find_cycle(family, number);
    if (cycle != nullptr) return &cycle->descriptor;
  }
  const interpreter::MachiningCycle* machining = interpreter::machining_cycle(number);
  return machining == nullptr ? nullptr : &machining->descriptor;
}

/// If a number means two cycles, the one for probing precedes.
Result<Response> find_cycle(const Request& request) {
  const int number = static_cast<int>(*request.integer("number"));
  const CycleDescriptor* cycle = find_descriptor(number);
  if (cycle == nullptr) {
    return Error{ErrorCode::CycleUnknown,
                 "cycle not found: " + std::to_string(number) + "; /v1/cycles lists all"};
  }
  return Response(200, "application/json", body_json(*cycle));
}

}  // namespace

void add_cycle_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<CycleDescriptor>("Cycle"));
  schemas.push_back(answer_schema<CyclesAnswer>("Cycles"));
}

void add_cycles_routes(Routes& add) {
  add("GET /v1/cycles listCycles open",
      [](const Request&) -> Result<Response> {
        static const auto answer = http::prepare(list_cycles());
        return answer;
      },
      {.summary = "Every cycle with its parameters and results",
       .outcomes = {{.meaning = "All cycles", .schema = "Cycles"}}});
  add("GET /v1/cycles/{number} getCycle open 404", find_cycle,
      {.summary = "One cycle; a number of both kinds is the touch-probe cycle",
       .parameters = {{.name = "number",
                       .place = http::ParameterPlace::Path,
                       .type = http::Integer{.min = 0, .max = 9999},
                       .description = "421"}},
       .outcomes = {{.meaning = "The cycle", .schema = "Cycle"}}});
}

}  // namespace fitgauge::api

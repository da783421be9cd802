#include "api/runs/setup_codec.hpp"

#include "api/runs/setup_builder.hpp"
#include "api/runs/setup_workpiece.hpp"
#include "api/service/document_routes.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kSetupExample =
    R"({"workpiece":{"features":[{"type":"block","min_mm":[0,0,-40],"max_mm":[100,80,0]},)"
    R"({"type":"bore","center_mm":[50,40],"diameter_mm":25.013}]}})";

/// What does not make sense together, unless a field that was refused already is why.
void check(const machine::Setup& setup, const std::string& pointer, FieldErrors& errors) {
  const auto valid = machine::validate(setup);
  if (valid) return;
  for (const Error& finding : valid.error().details) {
    std::string where = pointer + finding.where;
    if (!errors.has(where)) errors.add(finding.code, std::move(where), finding.message);
  }
}

}  // namespace

void members(auto& v, machine::Setup& setup) {
  v.optional("machine", setup.machine, Object<machine::MachineSetup>{"Machine"},
             "Axes, tools, touch probes and presets");
  v.optional("workpiece", setup, kWorkpieceForm, "What lies on the table; nothing when absent");
  builder_members(v);
  printing_members(v);
  v.optional("seed", setup.seed, Integer{},
             "Of the random parts of a contact: the same seed, the same run");
}

void add_setup_schemas(Schemas& schemas) {
  const auto add = [&schemas](std::string_view name, const auto& describe) {
    BodySchema v(Side::Order);
    describe(v);
    schemas.push_back({std::string(name), v.json()});
  };
  const auto add_nested = [&add]<class T>(const auto& form, T variable) {
    add(form.component, [&](BodySchema& v) { form.describe(v, variable); });
  };
  add_nested(axis_form(machine::Axis::X), machine::AxisSetup{});
  add_nested(axis_form(machine::Axis::A), machine::AxisSetup{});
  add_nested(kAxesForm, machine::MachineSetup{}.axes);
  schemas.push_back(order_schema<machine::AxisWords>("StartPosition"));
  schemas.push_back(order_schema<machine::ToolSetup>("Tool"));
  schemas.push_back(order_schema<machine::ProbeSetup>("Probe"));
  schemas.push_back(order_schema<machine::ToolTouchProbeSetup>("ToolTouchProbe"));
  schemas.push_back(order_schema<machine::CalibrationRing>("CalibrationRing"));
  add_nested(kStudForm, machine::Boss{});
  schemas.push_back(order_schema<machine::CalibrationSphere>("CalibrationSphere"));
  add_nested(kPresetForm, machine::Preset{});
  schemas.push_back(order_schema<machine::MachineSetup>("Machine"));
  std::vector<std::string> features;
  each_kind_of_feature([&](const FeatureKind& kind, auto feature) {
    features.push_back(schema::ref(kind.component));
    add(kind.component, [&](BodySchema& v) {
      v.member("type", kind.word, kind, kind.meaning);
      members(v, feature);
    });
  });
  schemas.push_back({"Feature", schema::any_of(features)});
  add_nested(kWorkpieceForm, machine::Setup{});
  schemas.push_back(order_schema<machine::Setup>("Setup", kSetupExample));
  schemas.push_back(names_schema("Setups", "setups", "m3"));
}

machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors) {
  machine::Setup setup;
  read_body(body, pointer, errors, setup);
  const JsonValue* const machine = body.find("machine");
  const auto has = [machine](std::string_view name) {
    return machine != nullptr && machine->find(name) != nullptr;
  };
  app::add_rows(tables, {has("tools"), has("probes"), has("presets")}, setup.machine);
  check(setup, pointer, errors);
  return setup;
}

}  // namespace fitgauge::api

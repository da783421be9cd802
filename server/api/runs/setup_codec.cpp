#include "api/runs/setup_codec.hpp"

#include "api/runs/setup_builder.hpp"
#include "api/runs/setup_reader.hpp"

namespace fitgauge::api {
namespace {

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

void read_setup(SetupFields& fields, machine::Setup& setup) {
  fields.object({"machine", "Axes, tools, touch probes and presets"}, "Machine",
                [&setup](SetupFields& machine) {
                  read_machine(machine, setup.machine);
                  name_builder_actions(machine);
                });
  fields.object({"workpiece", "What lies on the table; nothing when absent"}, "Workpiece",
                [&setup](SetupFields& workpiece) {
                  workpiece.array({"features", "Joined in this order"}, "Feature", setup.features,
                                  read_feature);
                });
  name_builder_actions(fields);
  name_printing(fields);
  fields.seed({"seed", "Of the random parts of a contact: the same seed, the same run"},
              setup.seed);
}

machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors) {
  machine::Setup setup;
  {
    SetupReader reader(body, pointer, errors);
    read_setup(reader, setup);
  }
  const JsonValue* const machine = body.find("machine");
  const auto has = [machine](std::string_view name) {
    return machine != nullptr && machine->find(name) != nullptr;
  };
  app::add_rows(tables, {has("tools"), has("probes"), has("presets")}, setup.machine);
  check(setup, pointer, errors);
  return setup;
}

}  // namespace fitgauge::api

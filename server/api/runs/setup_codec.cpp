#include "api/runs/setup_codec.hpp"

#include <limits>

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

machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors) {
  machine::Setup setup;
  app::GivenTables given;
  {
    SetupReader reader(body, pointer, errors);
    reader.object("machine", [&](SetupReader& machine) {
      FieldReader& fields = machine.fields();
      for (const auto* name : {"m_functions", "cycles"}) fields.optional(name);  // decode_builder
      given = {fields.has("tools"), fields.has("probes"), fields.has("presets")};
      setup.machine = read_machine(machine);
    });
    reader.object("workpiece", [&setup](SetupReader& workpiece) {
      workpiece.array("features", setup.features, read_feature);
    });
    for (const auto* name : {"m_functions", "cycles", "decimal_separator"}) {
      reader.fields().optional(name);  // decode_builder
    }
    setup.seed = static_cast<std::uint64_t>(
        reader.fields().integer_or("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  }
  app::add_rows(tables, given, setup.machine);
  check(setup, pointer, errors);
  return setup;
}

}  // namespace fitgauge::api

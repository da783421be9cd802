#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::cycle_247 {

constexpr std::array kParameters{CycleParameter{.id = q(339),
                                                .meaning = "Number or name of the preset",
                                                .kind = ValueKind::NumberOrText,
                                                .range = {0, 65535}}};

/// Returns the row whose column DOC has the name.
CycleResult<int> named_row(const machine::PresetTable& presets, const std::string& name) {
  const auto found = std::ranges::find_if(
      presets.rows(), [&](const auto& row) { return row.second.comment == name; });
  if (found == presets.rows().end()) return nc_error(1011, "no preset is named \"" + name + '"');
  return found->first;
}

CycleResult<void> activate(const CycleContext& context) {
  if (const std::string* name = context.arguments.text(q(339))) {
    const auto row = TRY(named_row(context.machine.state().presets, *name));
    return lift(context.machine.activate_preset(row));
  }
  const double number = context.arguments.number(339);
  if (number != std::nearbyint(number)) return nc_error(1011, "Q339 must be a whole number");
  return lift(context.machine.activate_preset(static_cast<int>(number)));
}

constinit const TouchProbeCycle kCycle247{
    {.family = CycleFamily::CyclDef,
     .number = 247,
     .name = "PRESETTING",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .errors = ErrorSet{1011},
     .simulated = "Activates the row and resets datum shift, mirroring, rotation and scaling. No "
                  "motion."},
    activate};

}  // namespace fitgauge::probing::cycle_247

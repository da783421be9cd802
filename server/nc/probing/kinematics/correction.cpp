#include "nc/probing/kinematics/correction.hpp"

#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {
namespace {

/// Returns `location of axis C (0.0012 mm, twice its uncertainty 0.0300 mm)` for the first
/// insignificant value; of an axis, its location is sufficient.
std::string insignificant(const AxisErrors& errors) {
  struct Kind {
    std::string_view name;
    std::string_view lever;
    const std::optional<FoundError>& found;
  };
  for (const auto& [kind, lever, found] :
       {Kind{"location", "", errors.location}, Kind{"direction", " at 100 mm", errors.tilt_deg},
        Kind{"zero", " at 100 mm", errors.zero_deg}}) {
    if (!found || found->is_significant) continue;
    return fmt::format("{} of axis {} ({:.4f} mm{}, twice its uncertainty {:.4f} mm)", kind,
                       name(errors.axis), found->size, lever, 2 * found->standard_uncertainty);
  }
  return {};
}

std::string insignificant(std::span<const AxisErrors> errors) {
  std::string all;
  for (const AxisErrors& axis : errors) {
    if (axis.is_significant()) continue;
    all += (all.empty() ? "" : ", ") + insignificant(axis);
  }
  return all;
}

double largest_location(std::span<const AxisErrors> errors) {
  double largest = 0;
  for (const AxisErrors& axis : errors) {
    if (axis.location) largest = std::max(largest, axis.location->size);
  }
  return largest;
}

using machine::MachineState;
using machine::Preset;

CycleResult<void> set_preset(const CycleContext& context, KinematicsProbing& probing) {
  const auto reference = TRY(probing.measure({}));
  const MachineState& state = context.state();
  const Vec3 centre = on_table(reference, state.kinematics, probing.tool());
  Preset row = state.preset_row(state.active_preset);
  row.frame.origin = {to_length(centre.x).to_mm(), to_length(centre.y).to_mm(),
                      to_length(centre.z).to_mm()};
  TRY(context.machine.write_preset(row));
  return context.machine.activate_preset(row.number);
}

}  // namespace

FitOptions fit_options(const CycleContext& context, bool directions) {
  return {.directions = directions,
          .only_significant = !context.state().kinematics_options.notes_insignificant};
}

CycleResult<void> correct_kinematics(const CycleContext& context,
                                     std::span<const AxisErrors> errors, bool is_corrected,
                                     const machine::Kinematics& corrected) {
  const machine::KinematicsOptions& options = context.state().kinematics_options;
  if (const std::string small = insignificant(errors); !small.empty()) {
    if (!is_corrected) return nc_error(1102, small + ": measure a larger range or more positions");
    const std::string_view taken = options.notes_insignificant ? "corrected" : "not corrected";
    TRY(context.host.note(
        fmt::format("cycle {}: {}: {}", context.descriptor().number, taken, small)));
  }
  if (!is_corrected) return {};
  const double largest = largest_location(errors);
  if (options.max_modification && largest > *options.max_modification) {
    const auto confirmed = TRY(context.host.confirm(
        fmt::format("the kinematics change by {:.4f} mm, more than max_modification_mm ({} mm)",
                    largest, *options.max_modification)));
    if (!confirmed) return {};
  }
  return context.machine.set_kinematics(corrected);
}

CycleResult<void> PresetAtSphere::check(const CycleContext& context) const {
  const MachineState& state = context.state();
  const Preset* row = state.presets.find(state.active_preset);
  if ((!sets_before_ && !sets_after_) || row == nullptr || !row->locked) return {};
  return make_fault(machine::FaultKind::PresetLocked,
                    fmt::format("the active preset {}", row->number));
}

CycleResult<void> PresetAtSphere::before(const CycleContext& context,
                                         KinematicsProbing& probing) const {
  if (!sets_before_) return {};
  TRY(probing.find());
  return set_preset(context, probing);
}

CycleResult<void> PresetAtSphere::after(const CycleContext& context,
                                        KinematicsProbing& probing) const {
  auto done = sets_after_ ? set_preset(context, probing) : probing.turn({});
  return done ? probing.retract() : done;
}

}  // namespace fitgauge::probing

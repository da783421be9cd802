#include "nc/probing/kinematics/correction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {
namespace {

/// `location of axis C (0.0012 mm, twice its uncertainty 0.0300 mm)` of the first that is
/// insignificant: a location tells enough of its axis.
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

}  // namespace

FitOptions fit_options(const CycleContext& context, bool directions) {
  return {.directions = directions,
          .only_significant = !context.machine.state().kinematics_options.notes_insignificant};
}

CycleResult<void> correct_kinematics(const CycleContext& context,
                                     std::span<const AxisErrors> errors, bool is_corrected,
                                     const machine::Kinematics& corrected) {
  const machine::KinematicsOptions& options = context.machine.state().kinematics_options;
  if (const std::string small = insignificant(errors); !small.empty()) {
    if (!is_corrected) {
      return nc_error(1102, small + ": measure a larger range or more positions");
    }
    const std::string_view taken = options.notes_insignificant ? "corrected" : "not corrected";
    if (auto noted = context.host.note(
            fmt::format("cycle {}: {}: {}", context.arguments.descriptor().number, taken, small));
        !noted) {
      return noted;
    }
  }
  if (!is_corrected) return {};
  const double largest = largest_location(errors);
  if (options.max_modification && largest > *options.max_modification) {
    const auto confirmed = context.host.confirm(
        fmt::format("the kinematics change by {:.4f} mm, more than max_modification_mm ({} mm)",
                    largest, *options.max_modification));
    if (!confirmed) return confirmed.error();
    if (!*confirmed) return {};
  }
  return lift(context.machine.set_kinematics(corrected));
}

}  // namespace fitgauge::probing

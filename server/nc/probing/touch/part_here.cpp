#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing {
namespace {

std::string described(const machine::PartFeature& part) {
  const auto [x, y] = part.length;
  if (part.diameter != 0)
    return fmt::format("{} of {} mm", part.is_boss ? "boss" : "bore", part.diameter);
  if (x == 0 || y == 0) return fmt::format("slot of {:.10g} mm", std::max(x, y));
  return fmt::format("{} of {:.10g} x {:.10g} mm", part.is_boss ? "boss" : "pocket", x, y);
}

/// Whether a cycle for such a part may be written for this one.
bool is_like(const machine::PartFeature& part, const PlannedPlace& place) {
  if (!place.length) return part.diameter != 0;
  if (part.diameter != 0) return false;
  const auto is_near = [&](std::size_t axis) {
    const double nominal = place.length->at(axis);
    return nominal == 0 || std::abs(part.length.at(axis) - nominal) <= nominal / 2;
  };
  return is_near(0) && is_near(1);
}

/// 421 and 422, 412 and 413, 408 and 409: inside and outside.
std::string for_other_side(int cycle, bool is_boss) {
  if (cycle == 405) return "cycle 405 probes in a bore";
  return fmt::format("cycle {}", is_boss ? cycle + 1 : cycle - 1);
}

}  // namespace

CycleFault with_part(CycleFault fault, const CycleContext& context, const WorkingPlane& plane,
                     std::span<const PlannedPlace> places) {
  const bool is_touch =
      fault.kind == machine::FaultKind::NoContact || fault.kind == machine::FaultKind::Collision;
  constexpr double kFar = 0.5;
  if (!is_touch) return fault;
  for (const PlannedPlace& place : places) {
    const bool is_outside = place.side == Side::Outside;
    auto parts = context.machine.part_features(plane.to_input(place.centre));
    std::erase_if(parts, [&](const auto& part) { return !is_like(part, place); });
    if (parts.empty()) continue;
    const auto same = std::ranges::find(parts, is_outside, &machine::PartFeature::is_boss);
    const machine::PartFeature& here = same == parts.end() ? parts.front() : *same;
    const bool is_other = here.is_boss != is_outside;
    const bool has_size = place.diameter != 0 && here.diameter != 0;
    if (!is_other && (!has_size || std::abs(here.diameter - place.diameter) <= kFar)) continue;
    const std::string remedy = !is_other ? fmt::format("Q262 is {} mm", place.diameter)
                               : !place.other_side.empty()
                                   ? place.other_side
                                   : for_other_side(context.descriptor().number, here.is_boss);
    fault.text += fmt::format("; the setup has a {} here: {}", described(here), remedy);
    return fault;
  }
  return fault;
}

CycleResult<std::vector<Contact>> touch_part(const CycleContext& context, ProbingMotion& motion,
                                             std::span<const Touch> touches,
                                             const PlannedPlace& place) {
  auto contacts = motion.touch_all(touches, context.number(260));
  if (contacts) return contacts;
  return with_part(contacts.error(), context, motion.plane(), std::span(&place, 1));
}

PlannedPlace width_place(Side side, const Vec3& centre, std::size_t axis, double width) {
  std::array<double, 2> length{};
  length.at(axis) = width;
  return {side, centre, 0, length};
}

}  // namespace fitgauge::probing

#include "nc/run/machining.hpp"

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {
namespace {

/// Cycle 240 may define the diameter of the countersink instead of its depth.
double depth(const MachiningDefinition& definition, const Tool* tool) {
  if (definition.value(343) != 1) return definition.value(201);
  const double point = tool == nullptr ? 0 : tool->point_angle;
  if (point <= 0 || point >= 180) return 0;
  return -std::abs(definition.value(344)) / 2 / std::tan(machine::radians(point / 2));
}

Heights heights_of(const MachiningDefinition& definition, const ToolMotion& motion) {
  Heights heights;
  if (definition.cycle->descriptor.dotted) {
    // The old cycles begin at their clearance: the surface is below the tool.
    heights.clearance = motion.height();
    heights.surface = heights.clearance - std::abs(definition.value(200));
    heights.second = heights.clearance;
  } else {
    const bool is_face = definition.cycle->shape == MachiningShape::FaceMilling;
    heights.surface = definition.value(is_face ? 227 : 203);
    heights.clearance = heights.surface + definition.value(200);
    heights.second = std::max(heights.clearance, heights.surface + definition.value(204));
  }
  heights.bottom = definition.cycle->shape == MachiningShape::FaceMilling
                       ? definition.value(386)
                       : heights.surface + depth(definition, motion.state().active_tool());
  return heights;
}

/// Notes a tool that does not cut, and a corner that is smaller than programmed.
NcResult<void> note_doubts(Channel& channel, const MachiningDefinition& definition) {
  const MachineState& state = channel.state();
  const MachiningShape shape = definition.cycle->shape;
  const int number = definition.cycle->descriptor.number;
  // Tapping and 241 start the spindle themselves.
  if (shape != MachiningShape::Tapping && number != 241 && !state.modes.turns())
    TRY(channel.note("cycle {} cuts with a standing spindle: give its speed S, and M3 or M4 before",
                     number));
  if (state.probe_system())
    TRY(channel.note("cycle {} machines with the touch probe, tool {}: call a cutter", number,
                     state.tool.number));
  // A rectangle has no larger corners than half of its shorter side.
  const double most = std::min(definition.value(218), definition.value(219)) / 2;
  if (shape != MachiningShape::RectangularStud || definition.value(220) <= most) return {};
  return channel.note(
      "the corner radius Q220 = {} is larger than half of the shorter side: {} mm is milled",
      definition.value(220), most);
}

/// The lanes of a surface: their positions and both ends. The tool enters from outside.
struct Lanes {
  Vec2 first;       ///< begin of the first one
  Vec2 step;        ///< from each to the next
  double near = 0;  ///< end at the starting point, main axis
  double far = 0;
  double count = 1;

  Vec2 end(double lane, bool at_far) const {
    return {at_far ? far : near, first.y + step.y * lane};
  }
};

Lanes lanes_of(const Machining& cycle, double radius) {
  const double forward = std::copysign(1, cycle.value(218));
  const double width = cycle.value(219);
  const double outside = radius + cycle.value(357);
  const double within = -std::min(radius, std::abs(cycle.value(218)) / 2);
  const double beyond = forward * (cycle.value(389) == 1 ? within : outside);
  Lanes lanes;
  lanes.count = std::max(
      1.0, std::ceil(std::abs(width) / (cycle.value(370) * radius) - tolerance::kSamePoint));
  lanes.step = {0, width / lanes.count};
  lanes.first = {cycle.value(225) - forward * outside,
                 cycle.value(226) + lanes.step.y - std::copysign(radius, width)};
  lanes.near = cycle.value(225) - beyond;
  lanes.far = cycle.value(225) + cycle.value(218) + beyond;
  return lanes;
}

}  // namespace

ToolMotion::ToolMotion(Machine& machine, RunBudget& budget)
    : machine_(machine),
      budget_(budget),
      plane_(WorkingPlane::across(machine.state().tool_axis())) {}

NcResult<void> ToolMotion::to_height(double height, const Feed& feed) {
  TRY(budget_.check());
  if (std::abs(height - this->height()) < tolerance::kSamePoint) return {};
  AxisWords target;
  target[plane_.normal] = height;
  return machine_.move({target, feed});
}

NcResult<void> ToolMotion::to_point(Vec2 point, const Feed& feed) {
  TRY(budget_.check());
  if (norm(point - this->point()) < tolerance::kSamePoint) return {};
  AxisWords target;
  target.values[plane_.first] = point.x;
  target.values[plane_.second] = point.y;
  return machine_.move({target, feed});
}

NcResult<void> ToolMotion::arc(Vec2 centre, Vec2 end, double sweep_deg, double height,
                               const Feed& feed) {
  TRY(budget_.check());
  TRY(check_scaling(state(), plane_, "an arc is"));
  Vec3 target = plane_.with(machine_.position().linear, end);
  target[index(plane_.normal)] = height;
  return machine_.move_arc({target, plane_.with(target, centre), sweep_deg, plane_.normal, feed});
}

NcResult<void> ToolMotion::dwell(double seconds) {
  TRY(budget_.check());
  return seconds > 0 ? machine_.dwell(seconds) : NcResult<void>();
}

NcResult<void> ToolMotion::set_modes(const Modes& modes) {
  return modes == state().modes ? NcResult<void>() : machine_.set_modes(modes);
}

Vec2 ToolMotion::point() const { return plane_.project(machine_.position().linear); }

double ToolMotion::height() const { return machine_.position().linear[index(plane_.normal)]; }

Feed feed_of(double rate) { return std::isinf(rate) ? Feed::rapid() : Feed::at(rate); }

Machining::Machining(const ToolMotion& tool, const MachiningDefinition& defined)
    : ToolMotion(tool), definition(defined), heights(heights_of(defined, tool)) {}

Feed Machining::feed(int parameter) const { return feed_of(value(parameter)); }

Feed Machining::retraction() const {
  if (!definition.gives(208)) return Feed::rapid();
  return feed(value(208) > 0 ? 208 : 206);
}

NcResult<void> Machining::start() {
  if (heights.bottom == heights.surface) {
    if (definition.value(343) == 1)
      return nc_error(1087, "Q343 is 1: T-ANGLE of the tool is 0, or Q344 is 0");
    return nc_error(1042, "Q201 is 0");
  }
  if (definition.cycle->descriptor.dotted) return {};  // the tool stands there
  return to_height(heights.clearance, Feed::rapid());
}

NcResult<void> Machining::leave() {
  if (heights.second <= heights.clearance) return {};
  return to_height(heights.second, Feed::rapid());
}

NcResult<void> check_values(const MachiningDefinition& definition) {
  const auto found = contradiction(definition.cycle->descriptor.number, [&](int parameter) {
    const auto at = definition.values.find(parameter);
    return at == definition.values.end() ? std::nullopt : std::optional(at->second);
  });
  return found ? nc_error(found->error, found->text) : NcResult<void>();
}

NcResult<void> machine_here(Channel& channel, const MachiningDefinition& definition) {
  const MachiningShape shape = definition.cycle->shape;
  if (shape > MachiningShape::Tapping && shape != MachiningShape::Engraving)
    TRY(check_scaling(channel.state(), working_plane(channel.machine()), "milling cycles are"));
  TRY(check_values(definition));
  Machining cycle({channel.machine(), channel.budget}, definition);
  TRY(note_doubts(channel, definition));
  if (shape == MachiningShape::Contour) return mill_contours(channel, cycle);
  // In the order of MachiningShape.
  constexpr NcResult<void> (*kMachine[])(Machining&) = {drill,
                                                        bore,
                                                        bore_back,
                                                        tap,
                                                        mill_bore,
                                                        mill_rectangle,
                                                        mill_circle,
                                                        mill_slot,
                                                        mill_circular_slot,
                                                        mill_rectangular_stud,
                                                        mill_circular_stud,
                                                        mill_face,
                                                        mill_thread,
                                                        engrave};
  static_assert(std::size(kMachine) == static_cast<std::size_t>(MachiningShape::PolarPattern));
  const auto index = static_cast<std::size_t>(shape);
  if (index < std::size(kMachine)) return kMachine[index](cycle);
  return nc_error(1027);  // they are not called
}

NcResult<void> mill_face(Machining& cycle) {
  const Heights& heights = cycle.heights;
  const double radius = cycle.tool_radius();
  if (radius <= 0) return nc_error(1002, "a face is milled with a tool that has a radius");
  if (heights.bottom == heights.surface) return {};  // the control does not run it
  const Lanes lanes = lanes_of(cycle, radius);
  const bool line_by_line = cycle.value(389) == 2;
  const auto to_next = cycle.feed(cycle.value(389) == 1 ? 207 : 253);
  if (cycle.height() < heights.second) TRY(cycle.to_height(heights.second, Feed::rapid()));
  TRY(cycle.to_point(lanes.first, Feed::rapid()));
  const double rough = std::min(heights.surface, heights.bottom + cycle.value(369));
  const double least = cycle.value(202) > 0 ? cycle.value(202) : heights.surface - rough;
  const double infeeds =
      least > 0 ? std::ceil((heights.surface - rough) / least - tolerance::kSamePoint) : 0;
  const double all = infeeds + (rough > heights.bottom ? 1 : 0);
  bool to_far = true;
  for (double infeed = 1; infeed <= all; ++infeed) {
    const double depth = infeed > infeeds
                             ? heights.bottom
                             : heights.surface - (heights.surface - rough) * infeed / infeeds;
    const auto feed = cycle.feed(infeed == all ? 385 : 207);
    const bool backwards = std::fmod(infeed, 2) == 0;
    if (infeed == 1) TRY(cycle.to_height(depth, cycle.feed(253)));
    for (double k = 0; k < lanes.count; ++k) {
      const double lane = backwards ? lanes.count - 1 - k : k;
      const bool enters = infeed == 1 && k == 0;
      if (line_by_line && !enters) {
        TRY(cycle.to_height(depth + cycle.value(200), cycle.feed(253)));
        TRY(cycle.to_point(lanes.end(lane, false), cycle.feed(253)));
      } else if (!enters) {
        TRY(cycle.to_point(lanes.end(lane, !to_far), to_next));
      }
      TRY(cycle.to_height(depth, cycle.feed(253)));
      TRY(cycle.to_point(lanes.end(lane, to_far), feed));
      if (!line_by_line) to_far = !to_far;
    }
  }
  return cycle.to_height(heights.second, Feed::rapid());
}

}  // namespace fitgauge::interpreter

#include "nc/probing/touch/probing_motion.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

using machine::AxisWords;
using machine::ContactPoint;
using machine::CoordinateSystem;
using machine::Feed;
using machine::MachineState;

/// Machine mm per mm of the input system along the main axis. @pre all scaling factors are equal.
double scale_of(const MachineState& state, machine::Axis main) {
  return norm(state.frames.direction_to_machine(unit_vector(main)));
}

CycleResult<Vec3> touch(const CycleContext& context, ProbingMotion& motion, const Vec3& nominal,
                        const Vec3& direction) {
  const std::array touches{
      Touch{.start = nominal - direction * motion.start_distance(), .direction = direction}};
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  return contacts.front().surface;
}

/// Returns two points of the edge on the touched side of the line through two ball centres.
std::array<Vec3, 2> edge_of(const Contact& first, const Contact& second, const Vec3& touched,
                            double radius) {
  const Vec3 along = second.ball_centre - first.ball_centre;
  Vec3 normal{-along.y, along.x, 0};
  const double length = norm(normal);
  if (length == 0) return {};
  normal = normal * ((dot(normal, touched) > 0 ? radius : -radius) / length);
  return {first.ball_centre + normal, second.ball_centre + normal};
}

}  // namespace

ProbingMotion::ProbingMotion(const CycleContext& context, const machine::ProbeSystem& probe)
    : context_(context),
      plane_(WorkingPlane::across(context.state().tool_axis())),
      probe_(probe),
      scale_(scale_of(context.state(), plane_.main)) {}

CycleResult<ProbingMotion> ProbingMotion::begin(const CycleContext& context) {
  using machine::FaultKind;
  using machine::make_fault;
  const MachineState& state = context.state();
  if (!state.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  if (state.active_tool() == nullptr) return make_fault(FaultKind::NoTool);
  const auto probe = state.probe_system();
  if (!probe) {
    return make_fault(
        FaultKind::NotAProbe,
        fmt::format("tool {} is not a touch probe: set its TP_NO", state.tool.number));
  }
  return ProbingMotion(context, *probe);
}

CycleResult<std::vector<Contact>> ProbingMotion::touch_all(std::span<const Touch> touches,
                                                           double clearance_height) {
  std::vector<Contact> contacts;
  for (const Touch& touch : touches) {
    const bool first = contacts.empty();
    TRY(first ? approach(touch, clearance_height) : transit(touch, clearance_height));
    auto contact = TRY(probe(touch.direction));
    contacts.push_back(contact);
  }
  if (std::isinf(clearance_height)) return contacts;
  TRY(move_tip_to_height(clearance_height));
  return contacts;
}

CycleResult<Contact> ProbingMotion::touch(const Touch& touch, double clearance_height) {
  TRY(approach(touch, clearance_height));
  return probe(touch.direction);
}

CycleResult<void> ProbingMotion::approach(const Touch& touch, double clearance_height) {
  if (tip().z < clearance_height) return via_clearance_height(touch.start, clearance_height);
  TRY(move_ball_in_plane(touch.start));
  return move_ball(touch.start);
}

CycleResult<void> ProbingMotion::transit(const Touch& touch, double clearance_height) {
  switch (touch.transit) {
    case Transit::Arc: return arc(touch);
    case Transit::ClearanceHeight: return via_clearance_height(touch.start, clearance_height);
    case Transit::Straight: break;
  }
  for (const Vec3& waypoint : touch.waypoints) TRY(move_ball(waypoint));
  return move_ball(touch.start);
}

CycleResult<void> ProbingMotion::via_clearance_height(const Vec3& start, double clearance_height) {
  TRY(move_tip_to_height(clearance_height));
  TRY(move_ball_in_plane(start));
  return move_ball(start);
}

CycleResult<void> ProbingMotion::arc(const Touch& touch) {
  const Vec3 offset = ball_offset();
  return context_.machine.move_arc({.end = plane_.to_input(touch.start) - offset,
                                    .centre = plane_.to_input(touch.arc_centre) - offset,
                                    .sweep_deg = touch.arc_sweep,
                                    .normal = plane_.probe,
                                    .feed = positioning_feed()});
}

CycleResult<Contact> ProbingMotion::probe(const Vec3& direction) {
  auto contact = context_.machine.probe({.direction = plane_.to_input(direction),
                                         .distance = probe_.data.distance,
                                         .feed = probe_.data.feed,
                                         .retract_feed = positioning_feed()});
  if (!contact && contact.error().kind == machine::FaultKind::NoContact) {
    return make_fault(
        machine::FaultKind::NoContact,
        fmt::format("nothing within DIST = {} mm of the start", probe_.data.distance));
  }
  if (!contact) return contact.error();
  publish_touch(context_.state(), context_.host, *contact);
  return Contact{plane_.from_input(contact->ball_centre), plane_.from_input(contact->surface)};
}

CycleResult<void> ProbingMotion::move_tip(const AxisWords& target) {
  return context_.machine.move({target, positioning_feed()});
}

CycleResult<void> ProbingMotion::move_ball(const Vec3& centre) {
  return move_tip(AxisWords::linear(plane_.to_input(centre) - ball_offset()));
}

CycleResult<void> ProbingMotion::move_ball_in_plane(const Vec3& centre) {
  Vec3 target = centre;
  target.z = (tip() + plane_.from_input(ball_offset())).z;
  return move_ball(target);
}

CycleResult<void> ProbingMotion::move_tip_to_height(double height) {
  AxisWords target;
  target[plane_.probe] = height;
  return move_tip(target);
}

Feed ProbingMotion::positioning_feed() const {
  const FastProbing& fast = context_.host.memory().fast_probing;
  if (fast.machine_rapid) return Feed::rapid();
  if (fast.positioning_feed > 0) return Feed::at(fast.positioning_feed);
  const bool machine_rapid = probe_.data.prepositioning == machine::PrePositioning::MachineRapid;
  return machine_rapid ? Feed::rapid() : Feed::rapid(probe_.data.rapid);
}

Vec3 ProbingMotion::tip() const { return plane_.from_input(context_.machine.position().linear); }

Vec3 ProbingMotion::ball_offset() const {
  return context_.state().ball_centre() - context_.machine.position().linear;
}

CycleResult<void> refuse_mirror_and_scaling(const machine::Frames& frames) {
  if (frames.is_mirrored()) return nc_error(1008, "reset cycle 8 before this cycle");
  if (frames.is_scaled()) return nc_error(1007, "reset cycles 11 and 26 before this cycle");
  return {};
}

void publish_touch(const MachineState& state, CycleHost& host, const ContactPoint& contact) {
  const Vec3 nose = state.frames.from_machine(contact.nose.linear, CoordinateSystem::Workpiece);
  set_lengths(host, 115, {nose.x, nose.y, nose.z});
  std::uint16_t number = 118;
  for (const machine::Axis axis : {machine::Axis::A, machine::Axis::B, machine::Axis::C}) {
    if (state.ranges[index(axis)] && number <= 119)
      host.set_q(number++, contact.nose[axis], Unit::Angle);
  }
  host.touched(contact);
}

double ProbedLine::angle_deg() const {
  const Vec3 along = direction();
  if (axis == 2) return machine::degrees(std::atan(along.z / along[across]));
  double angle = machine::degrees(std::atan2(along.y, along.x));
  const double lowest = axis == 1 ? -90 : 0;
  if (angle <= lowest) angle += 180;
  if (angle > lowest + 180) angle -= 180;
  return angle;
}

CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion) {
  const int direction = context.whole(267);
  const std::array nominal{place_of(context, 263, 264, 261), place_of(context, 265, 266, 261)};
  ProbedLine line;
  line.axis = static_cast<std::size_t>(context.whole(272) - 1);
  line.across = line.axis == 0 || (line.axis == 2 && nominal[0].x == nominal[1].x) ? 1 : 0;
  if (nominal[0][line.across] == nominal[1][line.across])
    return nc_error(1081, "both points lie at the same place of the line");
  Vec3 along;
  along[line.axis] = direction;
  const Vec3 back = along * motion.start_distance();
  const Transit between = context.whole(301) == 1 ? Transit::ClearanceHeight : Transit::Straight;
  const std::array touches{
      Touch{.start = nominal[0] - back, .direction = along},
      Touch{.start = nominal[1] - back, .direction = along, .transit = between}};
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  line.first = contacts.front().ball_centre;
  line.second = contacts.back().ball_centre;
  for (std::size_t k = 0; k < 2; ++k)
    line.coordinates[k] = {nominal[k][line.axis], contacts[k].surface[line.axis]};
  return line;
}

CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context,
                                                ProbingMotion& motion) {
  const int direction = context.whole(267);
  TouchedCoordinate touched{.axis = static_cast<std::size_t>(context.whole(272) - 1),
                            .nominal = place_of(context, 263, 264, 261),
                            .surface = {}};
  Vec3 along;
  along[touched.axis] = direction;
  touched.surface = TRY(touch(context, motion, touched.nominal, along));
  return touched;
}

CycleResult<Vec3> touch_down(const CycleContext& context, ProbingMotion& motion,
                             const Vec3& nominal) {
  return touch(context, motion, nominal, {0, 0, -1});
}

CycleResult<Vec3> intersection(const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2) {
  const Vec3 a = a2 - a1;
  const Vec3 b = b2 - b1;
  const double across = a.x * b.y - a.y * b.x;
  if (std::abs(across) <= tolerance::kParallelEdges * std::hypot(a.x, a.y) * std::hypot(b.x, b.y))
    return nc_error(1081, "the measured lines do not meet");
  const double part = ((b1.x - a1.x) * b.y - (b1.y - a1.y) * b.x) / across;
  return a1 + a * part;
}

CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius) {
  const auto main = edge_of(contacts[0], contacts[1], touches[0].direction, ball_radius);
  const auto secondary = edge_of(contacts[2], contacts[3], touches[2].direction, ball_radius);
  const auto point = TRY(intersection(main[0], main[1], secondary[0], secondary[1]));
  return Corner{point, contacts[1].ball_centre - contacts[0].ball_centre};
}

}  // namespace fitgauge::probing

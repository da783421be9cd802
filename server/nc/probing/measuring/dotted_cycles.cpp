#include "nc/probing/cycles.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::dotted_cycles {

using machine::FaultKind;
using namespace parameter;

constexpr CycleParameter pre_position(std::uint8_t part, ParameterId axis) {
  return in_part(part, optional(coordinate(axis, "Position before probing")));
}
constexpr CycleParameter kWordAxis =
    choice(ParameterId::WordAxis, "Probing axis: 0 X, 1 Y, 2 Z", 0, 2);
constexpr CycleParameter kWordDirection =
    choice(ParameterId::WordDirection, "Probing direction: -1 or +1", -1, 1);
constexpr CycleParameter kWordAngle =
    angle(ParameterId::WordAngle, "Probing angle from the axis", 360, 0);

constexpr std::array kTouchResults =
    list(results(115, Unit::Length, "Spindle position X at contact",
                 "Spindle position Y at contact", "Spindle position Z at contact"),
         results(118, Unit::Angle, "Fourth axis at contact", "Fifth axis at contact"));

constexpr std::array k0Parameters =
    list(result_parameter(0), in_part(0, kWordAxis), in_part(0, kWordDirection),
         pre_position(1, ParameterId::WordX), pre_position(1, ParameterId::WordY),
         pre_position(1, ParameterId::WordZ));

constexpr std::array k1Parameters =
    list(in_part(1, kWordAxis), in_part(1, kWordAngle), pre_position(2, ParameterId::WordX),
         pre_position(2, ParameterId::WordY), pre_position(2, ParameterId::WordZ));

/// The direction of ANGLE from the named axis towards the next one: X to Y, Y to Z, Z to X, as the
/// control counts angles in the planes XY, YZ and ZX.
machine::Vec3 angled_direction(const Arguments& arguments) {
  const auto axis = static_cast<std::size_t>(arguments.number(ParameterId::WordAxis));
  const auto [sine, cosine] = machine::sine_cosine(arguments.number(ParameterId::WordAngle));
  machine::Vec3 direction;
  direction[axis] = cosine;
  direction[(axis + 1) % 3] = sine;
  return direction;
}

/// Moves the tip in all axes at once to the position in the block, then touches and returns.
CycleResult<Contact> touch_from_position(const CycleContext& context, const Vec3& direction) {
  auto motion = TRY(begin_measurement(context));
  machine::AxisWords position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto id = static_cast<ParameterId>(static_cast<std::size_t>(ParameterId::WordX) + axis);
    if (context.has_number(id)) position.values[axis] = context.number(id);
  }
  TRY(motion.move_tip(position));
  return motion.probe(motion.plane().from_input(direction));
}

std::uint16_t result_of(const Arguments& arguments) {
  return static_cast<std::uint16_t>(arguments.number(ParameterId::WordResult));
}

CycleResult<void> reference_plane(const CycleContext& context) {
  const double sign = context.number(ParameterId::WordDirection);
  if (sign == 0) return nc_error(1042, "the sign of the probing direction is missing");
  const auto axis = static_cast<machine::Axis>(context.number(ParameterId::WordAxis));
  const auto contact = TRY(touch_from_position(context, unit_vector(axis) * sign));
  const WorkingPlane plane = WorkingPlane::across(context.state().tool_axis());
  const double coordinate = plane.to_input(contact.surface)[index(axis)];
  set_lengths(context.host, result_of(context), {coordinate});
  return {};
}

CycleResult<void> polar(const CycleContext& context) {
  TRY(touch_from_position(context, angled_direction(context)));
  return {};
}

constexpr double kLastResult = 1996;  ///< four parameters follow each other

/// The sub-lines 3 of cycles 3 and 4.
constexpr std::array kTouch{
    in_part(3, length(ParameterId::WordDistance, "Longest travel")),
    in_part(3, optional(ranged(ParameterId::WordFeed, "Probing feed, else that of the probe table",
                               Unit::Feed, {0, kLongest}))),
    in_part(3, optional(length(ParameterId::WordRetract,
                               "Way back after contact, at most to the start"))),
    in_part(3, choice(ParameterId::WordReferenceSystem,
                      "Results: 0 active system, 1 machine system", 0, 1, 0))};

constexpr std::array k3Parameters = list(
    result_parameter(1, kLastResult), in_part(2, kWordAxis), in_part(2, kWordAngle), kTouch,
    in_part(4, choice(ParameterId::WordErrorMode, "Without contact: 0 stop, 1 go on", 0, 1, 0)));

constexpr CycleParameter direction(ParameterId axis) {
  return in_part(2, plain(axis, "Component of the probing direction", -kLongest, kLongest, 0));
}

constexpr std::array k4Parameters =
    list(result_parameter(1, kLastResult), direction(ParameterId::WordX),
         direction(ParameterId::WordY), direction(ParameterId::WordZ), kTouch);

machine::ProbeMove probe_move(const Arguments& arguments, const Vec3& direction,
                              const machine::ProbeRow& probe) {
  machine::ProbeMove move{.direction = direction,
                          .distance = arguments.number(ParameterId::WordDistance),
                          .feed = probe.feed,
                          .retract_feed = machine::Feed::rapid(probe.rapid)};
  if (arguments.has_number(ParameterId::WordFeed))
    move.feed = arguments.number(ParameterId::WordFeed);
  if (arguments.has_number(ParameterId::WordRetract))
    move.retract = arguments.number(ParameterId::WordRetract);
  return move;
}

/// Touches from the present position. Four parameters receive the position at contact: X, Y, Z
/// without compensation of the ball, then 0, or -1 when nothing was touched.
CycleResult<void> measure(const CycleContext& context, const Vec3& direction, bool goes_on) {
  TRY(ProbingMotion::begin(context));
  const auto probe = context.state().probe_system();
  const std::uint16_t first = result_of(context);
  const auto fourth = static_cast<std::uint16_t>(first + 3);
  const auto contact = context.machine.probe(probe_move(context, direction, probe->data));
  if (!contact) {
    const FaultKind kind = contact.error().kind;
    const bool untouched = kind == FaultKind::NoContact || kind == FaultKind::StylusDeflected;
    if (!untouched || !goes_on) return contact.error();
    context.host.set_q(fourth, -1, Unit::None);
    return {};
  }
  publish_touch(context.state(), context.host, *contact);
  const bool in_machine = context.number(ParameterId::WordReferenceSystem) == 1;
  const Vec3& position = in_machine ? contact->nose.linear : contact->tip;
  set_lengths(context.host, first, {position.x, position.y, position.z});
  context.host.set_q(fourth, 0, Unit::None);
  return {};
}

CycleResult<void> measure_along_angle(const CycleContext& context) {
  return measure(context, angled_direction(context),
                 context.number(ParameterId::WordErrorMode) == 1);
}

CycleResult<void> measure_along_vector(const CycleContext& context) {
  const Vec3 direction{context.number(ParameterId::WordX), context.number(ParameterId::WordY),
                       context.number(ParameterId::WordZ)};
  if (direction == Vec3{}) return nc_error(1042, "the probing direction is zero");
  return measure(context, direction, true);
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(0, "REF. PLANE", CycleKind::Measuring, k0Parameters, kTouchResults,
          errors::kMeasuring | ErrorSet{1042}, reference_plane,
          "All parameters. The position is that of the tip; the result is compensated."),
    cycle(1, "POLAR DATUM", CycleKind::Measuring, k1Parameters, kTouchResults, errors::kMeasuring,
          polar,
          "All parameters. The position is that of the tip; the angle turns from the named "
          "axis to the next one (X to Y, Y to Z, Z to X)."),
    cycle(3, "MEASURING", CycleKind::Measuring, k3Parameters, kTouchResults,
          errors::kTouching | ErrorSet{1010, 1011}, measure_along_angle,
          "All parameters. X, Y and Z go to the result parameter and the two after it, 0 or "
          "-1 (no contact) to the fourth; the tip in the active system, the spindle nose "
          "in the machine system."),
    cycle(4, "MEASURING IN 3-D", CycleKind::Measuring, k4Parameters, kTouchResults,
          errors::kWithProbe | ErrorSet{1010, 1011, 1042}, measure_along_vector,
          "All parameters, results as of cycle 3; without contact the program goes on.")};

}  // namespace fitgauge::probing::dotted_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kDottedCycles = dotted_cycles::kCycles;

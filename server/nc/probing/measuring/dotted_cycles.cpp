#include "nc/probing/cycles.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::dotted_cycles {

using machine::FaultKind;
using namespace parameter;

constexpr CycleParameter pre_position(std::uint8_t part, ParameterId axis) {
  return in_part(part, {.id = axis,
                        .meaning = "Position before probing",
                        .unit = Unit::Length,
                        .range = {-kLongest, kLongest},
                        .required = false});
}

constexpr CycleParameter kWordAxis{.id = ParameterId::WordAxis,
                                   .meaning = "Probing axis: 0 X, 1 Y, 2 Z",
                                   .kind = ValueKind::Whole,
                                   .range = {0, 2}};
constexpr CycleParameter kWordDirection{.id = ParameterId::WordDirection,
                                        .meaning = "Probing direction: -1 or +1",
                                        .kind = ValueKind::Whole,
                                        .range = {-1, 1}};
constexpr CycleParameter kWordAngle{.id = ParameterId::WordAngle,
                                    .meaning = "Probing angle from the axis",
                                    .unit = Unit::Angle,
                                    .range = {-360, 360},
                                    .default_value = 0};

constexpr std::array<CycleOutput, 5> kTouchResults{
    {{115, "Spindle position X at contact", Unit::Length},
     {116, "Spindle position Y at contact", Unit::Length},
     {117, "Spindle position Z at contact", Unit::Length},
     {118, "Fourth axis at contact", Unit::Angle},
     {119, "Fifth axis at contact", Unit::Angle}}};

constexpr std::array k0Parameters{result_parameter(0),
                                  in_part(0, kWordAxis),
                                  in_part(0, kWordDirection),
                                  pre_position(1, ParameterId::WordX),
                                  pre_position(1, ParameterId::WordY),
                                  pre_position(1, ParameterId::WordZ)};

constexpr std::array k1Parameters{
    in_part(1, kWordAxis), in_part(1, kWordAngle), pre_position(2, ParameterId::WordX),
    pre_position(2, ParameterId::WordY), pre_position(2, ParameterId::WordZ)};

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

CycleResult<void> reference_plane(const CycleContext& context) {
  const double sign = context.number(ParameterId::WordDirection);
  if (sign == 0) return nc_error(1042, "the sign of the probing direction is missing");
  const auto axis = static_cast<machine::Axis>(context.number(ParameterId::WordAxis));
  const auto contact = TRY(touch_from_position(context, unit_vector(axis) * sign));
  const WorkingPlane plane = WorkingPlane::across(context.state().tool_axis());
  const double coordinate = plane.to_input(contact.surface)[index(axis)];
  set_length(context.host, static_cast<std::uint16_t>(context.number(ParameterId::WordResult)),
             coordinate);
  return {};
}

CycleResult<void> polar(const CycleContext& context) {
  TRY(touch_from_position(context, angled_direction(context)));
  return {};
}

constexpr double kLastResult = 1996;  ///< four parameters follow each other

constexpr CycleParameter kDistance{.id = ParameterId::WordDistance,
                                   .meaning = "Longest travel",
                                   .unit = Unit::Length,
                                   .range = {0, kLongest},
                                   .part = 3};
constexpr CycleParameter kFeed{.id = ParameterId::WordFeed,
                               .meaning = "Probing feed, else that of the probe table",
                               .unit = Unit::Feed,
                               .range = {0, kLongest},
                               .required = false,
                               .part = 3};
constexpr CycleParameter kRetract{.id = ParameterId::WordRetract,
                                  .meaning = "Way back after contact, at most to the start",
                                  .unit = Unit::Length,
                                  .range = {0, kLongest},
                                  .required = false,
                                  .part = 3};
constexpr CycleParameter kReferenceSystem{.id = ParameterId::WordReferenceSystem,
                                          .meaning = "Results: 0 active system, 1 machine system",
                                          .kind = ValueKind::Whole,
                                          .range = {0, 1},
                                          .default_value = 0,
                                          .part = 3};

constexpr std::array k3Parameters{result_parameter(1, kLastResult),
                                  in_part(2, kWordAxis),
                                  in_part(2, kWordAngle),
                                  kDistance,
                                  kFeed,
                                  kRetract,
                                  kReferenceSystem,
                                  CycleParameter{.id = ParameterId::WordErrorMode,
                                                 .meaning = "Without contact: 0 stop, 1 go on",
                                                 .kind = ValueKind::Whole,
                                                 .range = {0, 1},
                                                 .default_value = 0,
                                                 .part = 4}};

constexpr CycleParameter direction(ParameterId axis) {
  return {.id = axis,
          .meaning = "Component of the probing direction",
          .range = {-kLongest, kLongest},
          .default_value = 0,
          .part = 2};
}

constexpr std::array k4Parameters{result_parameter(1, kLastResult),
                                  direction(ParameterId::WordX),
                                  direction(ParameterId::WordY),
                                  direction(ParameterId::WordZ),
                                  kDistance,
                                  kFeed,
                                  kRetract,
                                  kReferenceSystem};

machine::ProbeMove probe_move(const Arguments& arguments, const Vec3& direction,
                              const machine::ProbeRow& probe) {
  machine::ProbeMove move{.direction = direction,
                          .distance = arguments.number(ParameterId::WordDistance),
                          .feed = probe.feed,
                          .retract = std::nullopt,
                          .retract_feed = machine::Feed::rapid(probe.rapid)};
  if (arguments.has_number(ParameterId::WordFeed)) {
    move.feed = arguments.number(ParameterId::WordFeed);
  }
  if (arguments.has_number(ParameterId::WordRetract)) {
    move.retract = arguments.number(ParameterId::WordRetract);
  }
  return move;
}

/// Touches from the present position. Four parameters receive the position at contact: X, Y, Z
/// without compensation of the ball, then 0, or -1 when nothing was touched.
CycleResult<void> measure(const CycleContext& context, const Vec3& direction, bool goes_on) {
  TRY(ProbingMotion::begin(context));
  const auto probe = context.state().probe_system();
  const auto first = static_cast<std::uint16_t>(context.number(ParameterId::WordResult));
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
  for (std::uint16_t axis = 0; axis < 3; ++axis) {
    context.host.set_q(static_cast<std::uint16_t>(first + axis), to_length(position[axis]).to_mm(),
                       Unit::Length);
  }
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

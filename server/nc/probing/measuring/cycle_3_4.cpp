#include "nc/probing/cycles.hpp"
#include "nc/probing/dotted_parameters.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::cycle_3_4 {

using machine::FaultKind;
using namespace parameter;

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
  const Arguments& arguments = context.arguments;
  TRY(ProbingMotion::begin(context));
  const auto probe = context.machine.state().probe_system();
  const auto first = static_cast<std::uint16_t>(arguments.number(ParameterId::WordResult));
  const auto fourth = static_cast<std::uint16_t>(first + 3);
  const auto contact = context.machine.probe(probe_move(arguments, direction, probe->data));
  if (!contact) {
    const FaultKind kind = contact.error().kind;
    const bool untouched = kind == FaultKind::NoContact || kind == FaultKind::StylusDeflected;
    if (!untouched || !goes_on) return from_machine(contact.error());
    context.host.set_q(fourth, -1, Unit::None);
    return {};
  }
  publish_touch(context.machine.state(), context.host, *contact);
  const bool in_machine = arguments.number(ParameterId::WordReferenceSystem) == 1;
  const Vec3& position = in_machine ? contact->nose.linear : contact->tip;
  for (std::uint16_t axis = 0; axis < 3; ++axis) {
    context.host.set_q(static_cast<std::uint16_t>(first + axis), to_length(position[axis]).to_mm(),
                       Unit::Length);
  }
  context.host.set_q(fourth, 0, Unit::None);
  return {};
}

CycleResult<void> measure_along_angle(const CycleContext& context) {
  return measure(context, angled_direction(context.arguments),
                 context.arguments.number(ParameterId::WordErrorMode) == 1);
}

CycleResult<void> measure_along_vector(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const Vec3 direction{arguments.number(ParameterId::WordX), arguments.number(ParameterId::WordY),
                       arguments.number(ParameterId::WordZ)};
  if (direction == Vec3{}) return nc_error(1042, "the probing direction is zero");
  return measure(context, direction, true);
}

constinit const TouchProbeCycle kCycle3 =
    cycle(3, "MEASURING", CycleKind::Measuring, k3Parameters, kTouchResults,
          errors::kTouching | ErrorSet{1010, 1011}, measure_along_angle,
          "All parameters. X, Y and Z go to the result parameter and the two after it, 0 or "
          "-1 (no contact) to the fourth; the tip in the active system, the spindle nose "
          "in the machine system.");

constinit const TouchProbeCycle kCycle4 =
    cycle(4, "MEASURING IN 3-D", CycleKind::Measuring, k4Parameters, kTouchResults,
          errors::kWithProbe | ErrorSet{1010, 1011, 1042}, measure_along_vector,
          "All parameters, results as of cycle 3; without contact the program goes on.");

}  // namespace fitgauge::probing::cycle_3_4

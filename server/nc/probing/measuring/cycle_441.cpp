#include "nc/probing/cycles.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::cycle_441 {

using namespace parameter;

constexpr std::array kParameters{
    CycleParameter{.id = q(396),
                   .meaning = "Positioning feed, 0: FMAX of the probe",
                   .unit = Unit::Feed,
                   .range = {0, kLongest},
                   .default_value = 0},
    choice(397, "Position with the rapid of the machine: 0 no, 1 yes", 0, 1, 0),
    choice(399, "Angle tracking: 0 no, 1 yes", 0, 1, 1),
    choice(400, "Automatic interruption: 0 no, 1 yes", 0, 1, 1),
    newer(choice(371, "Reaction of the touch point", 0, 1, 0))};

CycleResult<void> set_fast_probing(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  FastProbing fast{.positioning_feed = std::nullopt,
                   .machine_rapid = arguments.whole(397) == 1,
                   .angle_tracking = arguments.whole(399) == 1,
                   .interrupts = arguments.whole(400) == 1};
  if (arguments.number(396) > 0) fast.positioning_feed = arguments.number(396);
  context.host.memory().fast_probing = fast;
  return {};
}

constinit const TouchProbeCycle kCycle441 =
    cycle(441, "FAST PROBING", CycleKind::Other, kParameters, {}, {}, set_fast_probing,
          "Positioning feed, rapid and interruption hold for the cycles after it until the "
          "program ends.",
          "Angle tracking (Q399), which the simulated probe needs none of, and Q371: "
          "the values are checked and change nothing.");

}  // namespace fitgauge::probing::cycle_441

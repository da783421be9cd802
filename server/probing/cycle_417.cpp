#include <array>

#include "probing/cycles.hpp"
#include "probing/datum_transfer.hpp"
#include "probing/measured_value.hpp"
#include "probing/parameters.hpp"

namespace fitgauge::probing {
namespace {

using namespace parameter;

constexpr std::array kParameters{coordinate(263, "Point, main axis"),
                                 coordinate(264, "Point, secondary axis"),
                                 coordinate(294, "Point, probe axis"),
                                 kSetUpClearance,
                                 kClearanceHeight,
                                 kTableRow,
                                 coordinate(333, "New datum in the probe axis", 0),
                                 kTransfer};

constexpr std::array<CycleOutput, 1> kResults{{{160, "Measured coordinate", Unit::Length}}};

CycleResult<void> set_datum(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  if (auto prepared = prepare_preset(context); !prepared) return prepared;
  auto motion = ProbingMotion::begin(context);
  if (!motion) return motion.error();
  const Vec3 down{0, 0, -1};
  const Vec3 nominal{arguments.number(263), arguments.number(264), arguments.number(294)};
  const std::array touches{Touch{
      .start = nominal - down * motion->start_distance(arguments.number(320)), .direction = down}};
  const auto contacts = motion->touch_all(touches, arguments.number(260));
  if (!contacts) return contacts.error();
  const Vec3 surface = contacts->front().surface;
  context.host.set_q(160, to_length(surface.z).to_mm(), Unit::Length);
  const std::array points{DatumPoint{
      .point = surface, .axes = {false, false, true}, .datum = {0, 0, arguments.number(333)}}};
  return transfer_datum(context, motion->plane(), points);
}

}  // namespace

constinit const TouchProbeCycle kCycle417{{.number = 417,
                                           .name = "DATUM IN TS AXIS",
                                           .kind = CycleKind::Preset,
                                           .parameters = kParameters,
                                           .results = kResults,
                                           .simulated = "All parameters."},
                                          set_datum};

}  // namespace fitgauge::probing

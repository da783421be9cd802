#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/part_here.hpp"
#include "nc/probing/touch/rectangle_probing.hpp"

namespace fitgauge::probing::cycle_408_409 {

using namespace parameter;

constexpr std::array kGeometry{coordinate(321, "Centre, main axis"),
                               coordinate(322, "Centre, secondary axis"),
                               length(311, "Width"),
                               kMeasuringAxisInPlane,
                               kMeasuringHeight,
                               kSetUpClearance,
                               kClearanceHeight};
constexpr std::array kDatum =
    join(std::array{kTableRow, coordinate(405, "New datum", 0), kTransfer}, kProbeAxisDatum);

constexpr std::array k408Parameters = join(join(kGeometry, std::array{kMoveToClearance}), kDatum);
constexpr std::array k409Parameters = join(kGeometry, kDatum);

constexpr std::array<CycleOutput, 2> kResults{
    {{157, "Position of the centre line", Unit::Length}, {166, "Measured width", Unit::Length}}};

CycleResult<void> set_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const Arguments& arguments = context.arguments;
  const auto axis = static_cast<std::size_t>(arguments.whole(272) - 1);
  const Vec3 centre{arguments.number(321), arguments.number(322), arguments.number(261)};
  auto touches = width_touches(side, centre, axis, arguments.number(311),
                               motion.start_distance(arguments.number(320)));
  const bool moves = touches[0].start != touches[1].start;
  if (moves && (side == Side::Outside || arguments.whole(301) == 1)) {
    touches[1].transit = Transit::ClearanceHeight;
  }
  const auto contacts = TRY(touch_part(context, motion, touches, arguments.number(260),
                                       width_place(side, centre, axis, arguments.number(311))));

  const double first = contacts.front().surface[axis];
  const double second = contacts.back().surface[axis];
  DatumPoint found{.point = centre};
  found.point[axis] = (first + second) / 2;
  found.axes[axis] = true;
  found.datum[axis] = arguments.number(405);
  set_length(context.host, 157, found.point[axis]);
  set_length(context.host, 166, std::abs(first - second));
  return finish_preset(context, motion, found);
}

constinit const TouchProbeCycle kCycle408 =
    cycle(408, "SLOT CENTER REF PT", CycleKind::Preset, k408Parameters, kResults,
          errors::kDatumTransfer, after<begin_preset, set_datum, Side::Inside>, "All parameters.");

constinit const TouchProbeCycle kCycle409 =
    cycle(409, "RIDGE CENTER REF PT", CycleKind::Preset, k409Parameters, kResults,
          errors::kDatumTransfer, after<begin_preset, set_datum, Side::Outside>, "All parameters.");

}  // namespace fitgauge::probing::cycle_408_409

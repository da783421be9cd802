#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_420 {

using namespace parameter;

constexpr std::array kParameters = join(line(kMeasuringAxis), std::array{kMeasuringLog});

constexpr std::array<CycleOutput, 1> kResults{{{150, "Measured angle", Unit::Angle}}};

CycleResult<void> measure(const CycleContext& context, ProbingMotion& motion) {
  const auto edge = TRY(probe_line(context, motion));
  const double angle = to_angle(edge.angle_deg());
  context.host.set_q(150, angle, Unit::Angle);
  MeasuringLog log(context.arguments.descriptor(), context.host);
  log.section("Actual values");
  log.angle("Measured angle", angle);
  log.section("Further results");
  log.length("Measuring height", to_length(context.arguments.number(261)));
  TRY(deliver_log(context, std::move(log)));
  MeasuringRecord record{.cycle = context.arguments.descriptor().number};
  constexpr std::array<std::string_view, 2> kNames{"1st point", "2nd point"};
  for (std::size_t k = 0; k < 2; ++k) {
    record.sizes.push_back({.characteristic = kNames.at(k),
                            .is_position = true,
                            .nominal = to_length(edge.coordinates.at(k).nominal),
                            .measured = to_length(edge.coordinates.at(k).measured)});
  }
  context.host.record(record);
  return {};
}

constinit const TouchProbeCycle kCycle420 =
    cycle(420, "MEASURE ANGLE", CycleKind::Measuring, kParameters, kResults,
          errors::kMeasuring | ErrorSet{1042, 1081}, after<begin_measurement, measure>,
          "All parameters. The angle is that of the line to the main axis, with Q272 = 3 "
          "to the axis along which the points differ.");

}  // namespace fitgauge::probing::cycle_420

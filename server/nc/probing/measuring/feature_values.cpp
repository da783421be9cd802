#include "nc/probing/measuring/feature_values.hpp"

namespace fitgauge::probing {

std::array<MeasuredValue, 2> centre_values(const Arguments& arguments, Point2 centre) {
  const Length main = to_length(arguments.number(273));
  const Length secondary = to_length(arguments.number(274));
  return {MeasuredValue{.characteristic = "Centre, main axis",
                        .role = ValueRole::Position,
                        .nominal = main,
                        .measured = to_length(centre.x),
                        .limits = position_limits(main, to_length(arguments.number(279))),
                        .result_q = 151,
                        .deviation_q = 161,
                        .error_too_large = 1044,
                        .error_too_small = 1044},
          MeasuredValue{.characteristic = "Centre, secondary axis",
                        .role = ValueRole::Position,
                        .nominal = secondary,
                        .measured = to_length(centre.y),
                        .limits = position_limits(secondary, to_length(arguments.number(280))),
                        .result_q = 152,
                        .deviation_q = 162,
                        .error_too_large = 1045,
                        .error_too_small = 1045}};
}

}  // namespace fitgauge::probing

#pragma once

#include <vector>

#include "app/measurements/measurement.hpp"
#include "app/runs/run_report.hpp"

namespace fitgauge::app {

/// One record of each measuring cycle of a run: its first size, judged by the limits of the cycle's
/// block. A size whose check the block switches off has the widest limits there are. A cycle that
/// measures no size (0, 1, 420, 431) leaves none. The texts are views of the report and the order.
std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller);

}  // namespace fitgauge::app

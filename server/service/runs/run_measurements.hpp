#pragma once

#include <vector>

#include "record/measurement.hpp"
#include "service/runs/run_report.hpp"

namespace fitgauge::app {

/// The records of a run (decision 27): one for each value that a cycle judged by limits of its
/// block, so the cycle's verdict is among them. A cycle that judged nothing leaves its first value,
/// indeterminate, with the widest limits there are; 0 and 1 leave none. The texts are views of the
/// report and the order.
std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller);

}  // namespace fitgauge::app

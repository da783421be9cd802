#pragma once

#include <string>

#include "cli/record_commands.hpp"

namespace fitgauge::cli {

// `fitgauge capability` and `fitgauge chart`: figures of stored measurements.

struct CapabilityQuery : RecordQuery {
  std::string target_mm{};
  std::string confidence{};
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge capability`: the indices with their intervals, and whether the process is stable.
Outcome<ExitCode> run_capability(const Context& context, const CapabilityQuery& query);

struct ChartQuery : RecordQuery {
  std::string kind{};
  std::string rules{};      ///< 1,2,3,4
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge chart`: centre and limits of a control chart, and each violation of its rules.
Outcome<ExitCode> run_chart(const Context& context, const ChartQuery& query);

}  // namespace fitgauge::cli

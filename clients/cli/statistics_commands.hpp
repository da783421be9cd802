#pragma once

#include <string>

#include "cli/context.hpp"
#include "cli/record_commands.hpp"

namespace fitgauge::cli {

struct StatisticsOptions {
  std::string figure;       ///< summary, anova, …, or uncertainty
  std::string file;         ///< JSON, or a value a line; - is standard input
  std::string lower{};      ///< of capability
  std::string upper{};      ///< likewise
  std::string reference{};  ///< of type1
  std::string tolerance{};  ///< likewise
};

/// `fitgauge statistics summary values.txt`: what the service computes from what it is sent;
/// nothing is stored. A file that begins with a brace is sent as it is; of any other each line is a
/// value, or a subgroup of values apart by blanks, tabs, commas or semicolons (of anova a group).
Outcome<ExitCode> run_statistics(const Context& context, const StatisticsOptions& options);

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

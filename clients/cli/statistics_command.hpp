#pragma once

#include <string>

#include "cli/context.hpp"

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

}  // namespace fitgauge::cli

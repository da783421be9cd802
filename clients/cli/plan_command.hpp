#pragma once

#include <string>

#include "cli/context.hpp"

namespace fitgauge::cli {

struct PlanOptions {
  std::string file;
  std::string part{};  ///< the part whose plan it becomes; empty: it is printed
};

/// `fitgauge plan from FILE`: reads a STEP file of any size here, without the service, and prints
/// what was read beside what was not, or with `--part` stores the plan. Classes are those of the
/// standard. @errors LocalFile for a file that cannot be read, with its line.
Outcome<ExitCode> run_plan_from(const Context& context, const PlanOptions& options);

}  // namespace fitgauge::cli

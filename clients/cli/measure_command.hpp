#pragma once

#include "cli/context.hpp"
#include "cli/measure_journal.hpp"

namespace fitgauge::cli {

struct MeasureOptions {
  std::string input;  ///< a CSV file or a DFQ, or `-`
  std::string state_file{};
  std::size_t chunk_rows = 100'000;
  // Options that turn a table of the shop into measurements; without them it is sent unchanged.
  std::string encoding{};
  std::vector<std::string> columns{};    ///< `Istwert=measured_mm`
  std::vector<std::string> constants{};  ///< `machine=M3`
  std::string time_zone{};
  std::string length_unit{};  ///< of a DFQ without a unit
  bool leave_out_others = false;
  bool again = false;
  bool exit_verdict = false;  ///< the exit code is the worst verdict
};

/// Returns one line for each bad field of a chunk, with the line of the input: `night.csv:17:
/// measured_mm: …`. @param line_of converts a line of the body to a line of the input
std::string explain_rows(const Problem& problem, const std::string& input,
                         const std::function<std::uint64_t(std::uint64_t)>& line_of);

/// The worst verdict that was given: reject, rework, indeterminate, good.
ExitCode worst_verdict(const VerdictCounts& counts);

}  // namespace fitgauge::cli

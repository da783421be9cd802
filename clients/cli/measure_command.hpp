#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/context.hpp"
#include "cli/csv_chunks.hpp"
#include "cli/measure_journal.hpp"
#include "cli/problem.hpp"

namespace fitgauge::cli {

struct MeasureOptions {
  std::string input;  ///< a CSV file or a DFQ, or `-`
  std::string state_file{};
  std::size_t chunk_rows = 100'000;
  // How a table of the shop is turned into measurements; none of them: it is sent as it is.
  std::string encoding{};
  std::vector<std::string> columns{};    ///< `Istwert=measured_mm`
  std::vector<std::string> constants{};  ///< `machine=M3`
  std::string time_zone{};
  std::string length_unit{};  ///< of a DFQ that says none
  bool leave_out_others = false;
  bool again = false;
  bool exit_verdict = false;  ///< the exit code is the worst verdict
};

/// `fitgauge import`: stores the rows of a CSV, chunk by chunk, each with an idempotency key of
/// its own. What is stored, and what was sent last, is in the journal before it is needed: a run
/// that was stopped at any moment goes on where it was and stores nothing twice.
Outcome<ExitCode> run_measure(const Context& context, const MeasureOptions& options);

/// One line for each bad field of a chunk, with the line of the input: `night.csv:17: measured_mm:
/// …`. @param line_of the line of the input for one of the chunk's body
std::string explain_rows(const Problem& problem, const std::string& input,
                         const std::function<std::uint64_t(std::uint64_t)>& line_of);

/// The worst verdict that was given: reject, rework, indeterminate, good.
ExitCode worst_verdict(const VerdictCounts& counts);

}  // namespace fitgauge::cli

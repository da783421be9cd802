#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "cli/context.hpp"
#include "cli/measure_command.hpp"
#include "cli/outcome.hpp"
#include "qif/qif_csv.hpp"

namespace fitgauge::cli {

/// Whether a file is a DFQ of Q-DAS, by its name.
bool is_dfq(const std::string& path);

/// A QIF as rows, with the line of the document for each. @errors Usage, LocalFile
Outcome<qif::QifText> read_qif_input(const Context& context, const MeasureOptions& options);

/// A DFQ as the CSV that the service takes, read from front to back in a bounded piece of memory.
class DfqInput {
 public:
  /// @param context and options outlive it. @errors Usage, LocalFile
  static Outcome<DfqInput> open(const Context& context, const MeasureOptions& options);

  /// The next bytes of the CSV; 0 at the end. @errors LocalFile: the DFQ is wrong, with its line.
  Outcome<std::size_t> read(std::span<char> into);

  /// The line of the DFQ that a line of the CSV is from: reads the file again up to there.
  static std::uint64_t line_of(const Context& context, const MeasureOptions& options,
                               std::uint64_t csv_line);

 private:
  struct State;
  explicit DfqInput(std::shared_ptr<State> state) : state_(std::move(state)) {}
  /// The next rows. @returns false at the end.
  Outcome<bool> fill();

  std::shared_ptr<State> state_;
};

}  // namespace fitgauge::cli

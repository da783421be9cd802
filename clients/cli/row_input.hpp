#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "cli/context.hpp"
#include "cli/measure_command.hpp"
#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// A DFQ or a QIF as the CSV that the service takes, read from front to back in a bounded piece of
/// memory.
class RowInput {
 public:
  /// Whether a file is one of them, by its name.
  static bool is_one(const std::string& path);

  /// @param context and options outlive it. @errors Usage, LocalFile
  static Outcome<RowInput> open(const Context& context, const MeasureOptions& options);

  /// The next bytes of the CSV; 0 at the end. @errors LocalFile: the file is wrong, with its line.
  Outcome<std::size_t> read(std::span<char> into);

  /// The line of the file that a line of the CSV is from: reads the file again up to there.
  static std::uint64_t line_of(const Context& context, const MeasureOptions& options,
                               std::uint64_t csv_line);

 private:
  struct State;
  explicit RowInput(std::shared_ptr<State> state) : state_(std::move(state)) {}
  /// The next rows. @returns false at the end.
  Outcome<bool> fill();

  std::shared_ptr<State> state_;
};

}  // namespace fitgauge::cli

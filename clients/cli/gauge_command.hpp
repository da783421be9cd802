#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::cli {

/// Command line of `fitgauge gauge`, as typed; an empty text was not given.
struct GaugeOptions {
  std::string designation;  ///< or the nominal size, with limits of a drawing
  std::string measured{};   ///< mm, with a point or a comma; alternatively:
  std::string serial{};     ///< a port whose lines are values
  unsigned baud = 9600;
  std::string pattern{};  ///< of a line; its first group is the value
  bool record = false;
  std::array<std::string, api::RowField::Count> fields{};  ///< by RowField::Index, from Feature on
};

/// `fitgauge gauge 25H7 25.013`: judges a value, and stores it with --record; the exit code is the
/// verdict. With --serial judges line after line, until the port is gone or a value cannot be
/// stored.
Outcome<ExitCode> run_gauge(const Context& context, const GaugeOptions& options);

/// The text of a verdict or of a record: the word, the value, the distance to the nearest limit.
std::string format_verdict(const JsonValue& document, const Terminal& terminal);

/// Returns the text to send for a measured value. @param typed mm, with a point or a comma. @errors
/// Usage
Outcome<std::string> measured_text(const std::string& typed);

/// Prints the record or verdict of an answer; the exit code is its verdict.
Outcome<ExitCode> show_verdict(const Context& context, const Answer& answer);

/// @errors NoAnswer for another word.
Outcome<ExitCode> verdict_exit_code(std::string_view word);

/// The colour a verdict has everywhere in fitgauge.
Colour verdict_colour(std::string_view word);

}  // namespace fitgauge::cli

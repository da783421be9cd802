#pragma once

#include <string>
#include <string_view>

#include "cli/context.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// The command line of `fitgauge gauge`, as it was typed; an empty text was not given.
struct GaugeOptions {
  std::string designation;  ///< or the nominal size, with limits of a drawing
  std::string measured{};   ///< mm, with a point or a comma; or else:
  std::string serial{};     ///< a port whose lines are values
  unsigned baud = 9600;
  std::string pattern{};  ///< of a line; its first group is the value
  std::string rule{};
  std::string uncertainty_um{};
  std::string coverage_factor{};
  std::string probability{};
  // Corrects to 20 degrees.
  std::string temperature_c{};
  std::string scale_temperature_c{};
  std::string part_expansion{};
  std::string scale_expansion{};
  std::string part_material{};
  std::string scale_material{};
  std::string temperature_uncertainty_c{};
  std::string scale_temperature_uncertainty_c{};
  std::string part_uncertainty{};
  std::string scale_uncertainty{};
  // Limits of a drawing: the feature, and one or both.
  std::string feature{};
  std::string upper_um{};
  std::string lower_um{};
  bool record = false;
  // Fields of a record.
  std::string part_id{};
  std::string characteristic{};
  std::string order{};
  std::string operation{};
  std::string machine{};
  std::string operator_name{};
  std::string gauge{};
  std::string unit{};
  std::string measured_at{};
  std::string comment{};
};

/// `fitgauge gauge 25H7 25.013`: judges a value, and stores it with --record; the exit code is the
/// verdict. With --serial judges line after line, until the port is gone or a value cannot be
/// stored.
Outcome<ExitCode> run_gauge(const Context& context, const GaugeOptions& options);

/// The text of a verdict or of a record: the word, the value, the distance to the nearest limit.
std::string format_verdict(const JsonValue& document, const Terminal& terminal);

/// A measured value as it is sent. @param typed mm, with a point or a comma. @errors Usage
Outcome<std::string> measured_text(const std::string& typed);

/// Prints the record or verdict of an answer; the exit code is its verdict.
Outcome<ExitCode> show_verdict(const Context& context, const Answer& answer);

/// @errors NoAnswer for another word.
Outcome<ExitCode> verdict_exit_code(std::string_view word);

/// The colour a verdict has everywhere in fitgauge.
Colour verdict_colour(std::string_view word);

}  // namespace fitgauge::cli

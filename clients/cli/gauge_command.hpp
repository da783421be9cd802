#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// The text of a verdict or of a record: the word, the value, the distance to the nearest limit.
std::string format_verdict(const JsonValue& document, const Terminal& terminal);

/// The text to send for a measured value. @param typed mm, with point or comma. @errors Usage
Outcome<std::string> measured_text(const std::string& typed);

/// Prints the record or verdict of an answer; the exit code is its verdict.
Outcome<ExitCode> show_verdict(const Context& context, const Answer& answer);

/// @errors NoAnswer for another word.
Outcome<ExitCode> verdict_exit_code(std::string_view word);

/// The colour a verdict has everywhere in fitgauge.
Colour verdict_colour(std::string_view word);

}  // namespace fitgauge::cli

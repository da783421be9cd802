#pragma once

#include "cli/context.hpp"

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

/// Returns the text of a limits document. @param terminal that shows it
std::string format_limits(const JsonValue& limits, const Terminal& terminal);

/// The text of a fit document.
std::string format_fit(const JsonValue& fit, const Terminal& terminal);

/// `+21`, `0`, `-7` from the document's number.
std::string signed_text(std::string_view number);

}  // namespace fitgauge::cli

#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// Returns the text of a limits document. @param terminal that shows it
std::string format_limits(const JsonValue& limits, const Terminal& terminal);

/// The text of a fit document.
std::string format_fit(const JsonValue& fit, const Terminal& terminal);

/// `+21`, `0`, `-7` from the document's number.
std::string signed_text(std::string_view number);

}  // namespace fitgauge::cli

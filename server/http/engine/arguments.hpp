#pragma once

#include <string_view>

#include "base/result.hpp"
#include "http/route.hpp"

namespace fitgauge::http {

/// Reads the decoded text of a parameter as its type says; the value may view `text`.
/// @errors PathMalformed, QueryInvalid or RequestMalformed by the parameter's place, with its name
///   and what it takes; LengthMalformed, LengthTooFine, LengthOutOfRange for lengths.
Result<ArgumentValue> parse_argument(const Parameter& parameter, std::string_view text);

}  // namespace fitgauge::http

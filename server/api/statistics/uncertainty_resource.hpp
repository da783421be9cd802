#pragma once

#include "base/json/json_value.hpp"

namespace fitgauge::api {

/// The answer to a budget. @errors RequestInvalid with every bad field.
Result<std::string> compute_uncertainty(const JsonValue& body);

}  // namespace fitgauge::api

#pragma once

#include <string>

#include "base/json/json_value.hpp"
#include "base/json/schema.hpp"
#include "base/result.hpp"

namespace fitgauge::api {

/// The answer to a gauge study's body, by its method.
Result<std::string> gauge_study(const JsonValue& body);

void add_gauge_study_schemas(Schemas& schemas);

}  // namespace fitgauge::api

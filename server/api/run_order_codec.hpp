#pragma once

#include <functional>
#include <string>

#include "api/json_value.hpp"
#include "app/run_report.hpp"
#include "app/setup_service.hpp"

namespace fitgauge::api {

/// Finds a named setup; may wait.
using FindSetup = std::function<Result<app::NamedSetup>(const std::string& name)>;

/// Reads the body of POST /v1/runs. The order's request is the body with a named setup put in
/// place, so that it can be sent again.
/// @errors RequestInvalid with every bad field; those of `find_setup` but SetupUnknown.
Result<app::RunOrder> decode_run_order(JsonValue body, const FindSetup& find_setup);

}  // namespace fitgauge::api

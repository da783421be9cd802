#pragma once

#include <string>
#include <string_view>

#include "app/runs/run_report.hpp"

namespace fitgauge::api {

/// `{"moves":[...]}`, one move a line; lengths in mm to the tenth of a nanometre.
std::string trace_json(const app::RunTrace& trace);

/// The same as CSV, from the JSON. @errors StorageCorrupt when that cannot be read.
Result<std::string> trace_csv(std::string_view json);

}  // namespace fitgauge::api

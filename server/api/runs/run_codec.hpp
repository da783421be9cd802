#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {

/// How runs are written: the run object of the contract, its trace, its event.
app::RunFormat run_format();

/// `{"Q1":25,"QS3":"GOOD"}`
void write_parameters(JsonWriter& json, std::span<const interpreter::ParameterValue> parameters);

/// The run object of a run that is not over yet.
std::string unfinished_run_json(const app::ActiveRun& run);
/// The same of a run that is known to the store alone.
std::string unfinished_run_json(const app::StoredRun& run);

/// `next` of a page that ends before run `id`.
/// `{"runs":[{"id","status","program","created_at","finished_at"},...],"next"}`
/// @param next the cursor; empty on the last page
std::string run_page_json(const app::RunService::Page& page, std::string_view next);

/// `{"diagnostics":[...]}`
std::string diagnostics_json(const std::vector<klartext::Diagnostic>& diagnostics);
void write_diagnostics(JsonWriter& json, const std::vector<klartext::Diagnostic>& diagnostics);

}  // namespace fitgauge::api

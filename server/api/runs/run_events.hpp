#pragma once

#include <memory>

#include "app/runs/active_run.hpp"
#include "http/response.hpp"

namespace fitgauge::api {

/// Server-Sent Events of a run that is queued or under way: `progress` (status and blocks so far),
/// `output` (a line of the screen), `end` (the run object).
http::Response run_events(std::shared_ptr<app::ActiveRun> run);

/// The same of a run that is over.
http::Response finished_run_events(const std::string& report);

}  // namespace fitgauge::api

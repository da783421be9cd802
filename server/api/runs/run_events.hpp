#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "http/response.hpp"
#include "service/runs/active_run.hpp"

namespace fitgauge::api {

/// Server-Sent Events of a run that is queued or under way: `progress` (status and blocks so far),
/// `output` (a line of the screen), `end` (the run object). The id of an event is the number of
/// lines told so far, or `end`.
/// @param last the id of the last event the reader had: it gets the lines that follow, and 204
///   after `end`, upon which a browser asks no more.
http::Response run_events(std::shared_ptr<app::ActiveRun> run,
                          std::optional<std::string_view> last);

/// The same of a run that is over. @errors StorageCorrupt when the report cannot be read.
Result<http::Response> finished_run_events(const std::string& report,
                                           std::optional<std::string_view> last);

}  // namespace fitgauge::api

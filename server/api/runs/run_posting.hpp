#pragma once

#include "api/services.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {

// For a control that shows a machine and starts its programs. Both wait; not for I/O threads.

/// The machine of a named setup with the rows of the control's tables; without a name the default.
/// @errors SetupUnknown; RequestInvalid, TableFileMalformed: it cannot be built;
/// StorageUnavailable.
Result<machine::Setup> machine_of_setup(const Services& services, const std::string& name);

/// Starts a stored program on that machine like POST /v1/runs, with the largest limits of a run.
/// @errors as POST /v1/runs.
Result<std::shared_ptr<app::ActiveRun>> start_program(const Services& services,
                                                      const interpreter::ControlPath& program,
                                                      const std::string& setup);

/// POST /v1/runs: checks the order, starts the run, responds at its end or at once, as preferred.
void post_run(const Services& services, const Request& request, Responder responder);

/// Server-Sent Events of a queued or running run: `progress` (status and blocks so far), `output`
/// (a line of the screen), `end` (the run object). The id of an event is the number of lines sent
/// so far, or `end`.
/// @param last id of the last event that the reader has: it gets the lines that follow, and 204
/// after `end`, so that a browser stops.
Response run_events(std::shared_ptr<app::ActiveRun> run, std::optional<std::string_view> last);

/// Returns the events of a finished run. @errors StorageCorrupt if the report cannot be read.
Result<Response> finished_run_events(const std::string& report,
                                     std::optional<std::string_view> last);

}  // namespace fitgauge::api

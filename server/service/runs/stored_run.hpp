#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "service/runs/run_report.hpp"

namespace fitgauge::store {
struct Run;
enum class RunStatus : std::uint8_t;
}  // namespace fitgauge::store

namespace fitgauge::app {

/// A run as the store has it.
struct StoredRun {
  std::int64_t id = 0;
  std::string_view origin;  ///< of the data folder
  RunState state = RunState::Queued;
  std::string program;
  std::string request;
  std::string report;  ///< empty until it is over
  Timestamp created_at;
  std::optional<Timestamp> finished_at;

  std::string id_text() const { return run_id_text(id, origin); }
};

store::RunStatus run_status(RunState state);
RunState run_state(store::RunStatus status);
/// @param origin of the data folder
StoredRun stored_run(store::Run run, std::string_view origin);

}  // namespace fitgauge::app

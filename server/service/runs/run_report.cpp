#include "service/runs/run_report.hpp"

#include <algorithm>
#include <array>

namespace fitgauge::app {
namespace {

constexpr std::array<std::string_view, 7> kWords = {
    "queued", "running", "completed", "stopped", "failed", "limit_exceeded", "cancelled"};

}  // namespace

std::string_view word(RunState state) { return kWords[static_cast<std::size_t>(state)]; }

std::optional<RunState> run_state_from_word(std::string_view text) {
  const auto found = std::find(kWords.begin(), kWords.end(), text);
  if (found == kWords.end()) return std::nullopt;
  return static_cast<RunState>(found - kWords.begin());
}

RunState state_of(interpreter::RunStatus status) {
  switch (status) {
    case interpreter::RunStatus::Completed: return RunState::Completed;
    case interpreter::RunStatus::Stopped: return RunState::Stopped;
    case interpreter::RunStatus::LimitExceeded: return RunState::LimitExceeded;
    case interpreter::RunStatus::Cancelled: return RunState::Cancelled;
    case interpreter::RunStatus::Failed: break;
  }
  return RunState::Failed;
}

}  // namespace fitgauge::app

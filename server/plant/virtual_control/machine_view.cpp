#include "plant/virtual_control/machine_view.hpp"

#include <fmt/format.h>

namespace fitgauge::virtual_control {
namespace {

using app::RunState;
using control_link::ControlError;
using control_link::Mode;
using control_link::ProgramState;

/// How long a running program is waited for until it tells where it is.
constexpr std::chrono::milliseconds kMachinePatience{50};

bool is_under_way(RunState state) {
  return state == RunState::Queued || state == RunState::Running;
}

ProgramState shown(RunState state) {
  switch (state) {
    case RunState::Queued:
    case RunState::Running: return ProgramState::Started;
    case RunState::Completed: return ProgramState::Finished;
    case RunState::Stopped: return ProgramState::Stopped;
    case RunState::Failed: return ProgramState::Failed;
    case RunState::LimitExceeded: return ProgramState::Interrupted;
    case RunState::Cancelled: return ProgramState::Cancelled;
  }
  return ProgramState::Idle;
}

/// Where the axes stand before the first program.
double at_rest(const machine::Setup& setup, machine::Axis axis) {
  if (const auto start = setup.machine.start[axis]) return *start;
  const auto& range = setup.machine.axes[machine::index(axis)];
  return axis == machine::Axis::Z ? range->max : 0;
}

ControlError refusal_of_program(const Error& error) {
  switch (error.code) {
    case ErrorCode::ProgramUnknown: return ControlError::NoFile;
    case ErrorCode::ProgramInvalid:
    case ErrorCode::RequestInvalid: return ControlError::BadFormat;
    case ErrorCode::Overloaded: return ControlError::InUse;
    default: return ControlError::Failed;
  }
}

}  // namespace

/// A program that has begun switches the control to automatic, whoever started it. One that was
/// started here counts from then on, though it may have to wait for a worker.
std::shared_ptr<app::ActiveRun> MachineView::newest() {
  auto run = runs_.newest();
  if (started_ != nullptr && (run == nullptr || run->id() < started_->id())) run = started_;
  if (run != nullptr && run->id() != seen_run_) {
    seen_run_ = run->id();
    mode_ = Mode::Automatic;
  }
  return run;
}

app::LiveState MachineView::look() {
  const auto run = newest();
  return run == nullptr ? app::LiveState() : run->look(app::Look::State, kMachinePatience);
}

control_link::Axes MachineView::axes() {
  app::LiveState state = look();
  if (state.axes.empty()) {
    for (const machine::Axis axis : machine::kAllAxes) {
      if (setup_.machine.axes[machine::index(axis)]) {
        state.axes.emplace_back(axis, at_rest(setup_, axis));
      }
    }
  }
  control_link::Axes shown;
  for (const auto& [axis, position] : state.axes) {
    shown.axes.positions.push_back(fmt::format("{:.4f}", position));
    shown.axes.names.emplace_back(machine::name(axis));
  }
  return shown;
}

Mode MachineView::mode() {
  newest();
  return mode_;
}

/// A key counts after a program that has begun before it.
void MachineView::set_mode(Mode mode) {
  newest();
  mode_ = mode;
}

ProgramState MachineView::state() {
  const auto run = newest();
  return run == nullptr ? ProgramState::Idle : shown(run->state());
}

control_link::ProgramStack MachineView::program() {
  const auto run = newest();
  if (run == nullptr) return {};
  app::LiveState state = run->look(app::Look::State, kMachinePatience);
  return {.line = state.block,
          .main = run->program(),
          .current = state.program.empty() ? run->program() : std::move(state.program)};
}

control_link::SpindleTool MachineView::tool() {
  const app::LiveState state = look();
  return {.number = static_cast<std::uint32_t>(state.tool),
          .index = 0,
          .axis = static_cast<std::uint16_t>(machine::index(state.tool_axis)),
          .length = {state.tool_length},
          .radius = {state.tool_radius}};
}

std::vector<interpreter::RunMessage> MachineView::errors() { return look().errors; }

control_link::ControlResult<std::shared_ptr<app::ActiveRun>> MachineView::start(
    const interpreter::ControlPath& program) {
  const auto run = newest();
  if (run != nullptr && is_under_way(run->state())) return ControlError::WrongMode;
  auto started = start_(program);
  if (!started) return refusal_of_program(started.error());
  started_ = *std::move(started);
  return started_;
}

void MachineView::stop() {
  if (const auto run = newest(); run != nullptr) runs_.cancel(run);
}

}  // namespace fitgauge::virtual_control

#pragma once

#include "plant/lsv2/link/messages.hpp"
#include "plant/virtual_control/virtual_control.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::virtual_control {

using control_link::ControlError;
using control_link::ControlResult;
using control_link::DataValue;
using control_link::ProgramState;

/// The machine for DNC telegrams: the machine of the newest run, running or finished; before the
/// first run, at rest as in its setup. Used by one thread.
class MachineView {
 public:
  MachineView(app::RunService& runs, machine::Setup setup, StartProgram start)
      : runs_(runs), setup_(std::move(setup)), start_(std::move(start)) {}

  control_link::Axes axes() {
    app::LiveState state = look();
    if (state.axes.empty()) {
      for (const machine::Axis axis : machine::kAllAxes) {
        if (setup_.machine.axes[machine::index(axis)]) state.axes.emplace_back(axis, at_rest(axis));
      }
    }
    control_link::Axes shown;
    for (const auto& [axis, position] : state.axes) {
      shown.axes.positions.push_back(fmt::format("{:.4f}", position));
      shown.axes.names.emplace_back(machine::name(axis));
    }
    return shown;
  }

  control_link::Mode mode() {
    newest();
    return mode_;
  }
  /// A key counts after a program that has begun before it.
  void set_mode(control_link::Mode mode) {
    newest();
    mode_ = mode;
  }

  ProgramState state() {
    const auto run = newest();
    if (run == nullptr) return ProgramState::Idle;
    using app::RunState;
    switch (run->state()) {
      case RunState::Queued:
      case RunState::Running:
      case RunState::Cancelling: return ProgramState::Started;
      case RunState::Completed: return ProgramState::Finished;
      case RunState::Stopped: return ProgramState::Stopped;
      case RunState::Failed: return ProgramState::Failed;
      case RunState::LimitExceeded: return ProgramState::Interrupted;
      case RunState::Cancelled: return ProgramState::Cancelled;
    }
    return ProgramState::Idle;
  }

  control_link::ProgramStack program() {
    const auto run = newest();
    if (run == nullptr) return {};
    const app::LiveState state = run->look(app::Look::State, kPatience);
    return {.line = state.block,
            .main = run->program(),
            .current = state.program.empty() ? run->program() : state.program};
  }

  control_link::SpindleTool tool() {
    const app::LiveState state = look();
    return {.number = static_cast<std::uint32_t>(state.tool),
            .axis = static_cast<std::uint16_t>(machine::index(state.tool_axis)),
            .length = {state.tool_length},
            .radius = {state.tool_radius}};
  }

  std::vector<interpreter::RunMessage> errors() { return look().errors; }

  /// @errors WrongMode while a program runs; NoFile; BadFormat: it has errors; InUse: too many
  /// wait.
  ControlResult<void> start(const interpreter::ControlPath& program) {
    if (state() == ProgramState::Started) return ControlError::WrongMode;
    auto started = start_(program);
    if (started) {
      started_ = *std::move(started);
      return {};
    }
    switch (started.error().code) {
      case ErrorCode::ProgramUnknown: return ControlError::NoFile;
      case ErrorCode::ProgramInvalid:
      case ErrorCode::RequestInvalid: return ControlError::BadFormat;
      case ErrorCode::Overloaded: return ControlError::InUse;
      default: return ControlError::Failed;
    }
  }
  /// Ends the running program soon.
  void stop() {
    if (const auto run = newest(); run != nullptr) runs_.cancel(run);
  }

 private:
  /// Maximum wait for the position of a running program.
  static constexpr std::chrono::milliseconds kPatience{50};

  /// A started program switches the control to automatic, from any client. A program that was
  /// started here counts from then on, even while it waits for a worker.
  std::shared_ptr<app::ActiveRun> newest() {
    auto run = runs_.newest();
    if (started_ != nullptr && (run == nullptr || run->id() < started_->id())) run = started_;
    if (run != nullptr && run->id() != seen_run_) {
      seen_run_ = run->id();
      mode_ = control_link::Mode::Automatic;
    }
    return run;
  }
  app::LiveState look() {
    const auto run = newest();
    return run == nullptr ? app::LiveState() : run->look(app::Look::State, kPatience);
  }
  /// Position of an axis before the first program.
  double at_rest(machine::Axis axis) const {
    if (const auto start = setup_.machine.start[axis]) return *start;
    return axis == machine::Axis::Z ? setup_.machine.axes[machine::index(axis)]->max : 0;
  }

  app::RunService& runs_;
  const machine::Setup setup_;
  const StartProgram start_;
  control_link::Mode mode_ = control_link::Mode::Manual;
  std::int64_t seen_run_ = 0;
  std::shared_ptr<app::ActiveRun> started_;  ///< the last run that a client has started
};

// The PLC of a machine without one: every cell is 0 and every string empty.

/// The end of the last area below.
inline constexpr std::uint32_t kMemoryEnd = 0x12000;
inline const control_link::Parameters kControlParameters{
    .memory = {0, 10'000,      // markers
               0x4000, 1'024,  // inputs
               0x5000, 1'024,  // outputs
               0x6000, 144,    // counters
               0x7000, 144,    // timers
               0x8000, 8'192,  // words
               0xC000, 100},   // strings
    .string_bytes = 128,
    .word_memory = {0x10000, 512,   // input words
                    0x11000, 512},  // output words
    .version = 1,
    .largest_buffer = control_link::kLargestBuffer};

/// A value by its data path, `\PLC\memory\W\2`: the type of the path, and 0.
/// @errors WrongParameter: a path of another tree.
inline ControlResult<DataValue> read_data_path(std::string_view path) {
  const auto zero = [](std::uint32_t type, std::size_t bytes) {
    return DataValue{.type = type, .value = {std::string(bytes, '\0')}};
  };
  constexpr std::string_view kMemory = "\\PLC\\memory\\";
  if (path.starts_with(kMemory) && path.size() > kMemory.size()) {
    switch (path[kMemory.size()]) {
      case 'M':
      case 'I':
      case 'O': return zero(DataValue::kBool, 1);
      case 'B':
      case 'W': return zero(DataValue::kShort, 2);
      case 'D':
      case 'K': return zero(DataValue::kLong, 4);
      case 'S': return zero(DataValue::kText, 1);
      default: return ControlError::WrongParameter;
    }
  }
  if (path.starts_with("\\PLC\\program\\symbol\\")) return zero(DataValue::kLong, 4);
  if (path.starts_with("\\TABLE\\TOOL\\T\\")) return zero(DataValue::kDouble, 8);
  return ControlError::WrongParameter;
}

/// A bitmap (BMP) of 640 by 480 in the colour of the program's state, because the simulation has no
/// screen: green runs, red failed, grey else.
inline std::string screen_dump(ProgramState state) {
  constexpr std::uint32_t kWidth = 640;
  constexpr std::uint32_t kHeight = 480;
  constexpr std::uint32_t kPixels = kWidth * kHeight / 8;
  constexpr std::uint32_t kHead = 14 + 40 + 2 * 4;
  constexpr std::uint32_t kOnePlaneOfOneBit = 0x10001;
  const std::uint32_t colour = state == ProgramState::Started  ? 0x2E9E4F
                               : state == ProgramState::Failed ? 0xC0392B
                                                               : 0x9AA3AB;
  std::string bytes = "BM";
  for (const std::uint32_t value :
       {kHead + kPixels, 0U, kHead, 40U, kWidth, kHeight, kOnePlaneOfOneBit, 0U, kPixels, 2835U,
        2835U, 2U, 2U, colour, colour}) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFFU);
  }
  return bytes + std::string(kPixels, '\0');
}

}  // namespace fitgauge::virtual_control

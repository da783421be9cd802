#include "plant/virtual_control/virtual_disk.hpp"

namespace fitgauge::virtual_control {
namespace {

using app::RunState;
using control_link::ControlError;
using control_link::Mode;
using control_link::ProgramState;

/// Maximum wait for the position of a running program.
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

/// Position of the axes before the first program.
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

using control_link::DataValue;

/// The end of the last area below.
constexpr std::uint32_t kMemoryEnd = 0x12000;
constexpr std::uint8_t kStringBytes = 128;

DataValue zero(std::uint32_t type, std::size_t bytes) {
  return {.type = type, .value = {std::string(bytes, '\0')}};
}

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;
constexpr std::uint32_t kPixels = kWidth * kHeight / 8;
constexpr std::uint32_t kHead = 14 + 40 + 2 * 4;

void put(std::string& bytes, std::uint32_t value, int count = 4) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
}

std::uint32_t colour(control_link::ProgramState state) {
  switch (state) {
    case control_link::ProgramState::Started: return 0x2E9E4F;
    case control_link::ProgramState::Failed: return 0xC0392B;
    default: return 0x9AA3AB;
  }
}

}  // namespace

/// A started program switches the control to automatic, from any client. A program that was started
/// here counts from then on, even while it waits for a worker.
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

control_link::ControlResult<std::shared_ptr<app::ActiveRun>> MachineView::start(
    const interpreter::ControlPath& program) {
  const auto run = newest();
  if (run != nullptr && is_under_way(run->state())) return ControlError::WrongMode;
  auto started = start_(program);
  if (!started) return refusal_of_program(started.error());
  started_ = *std::move(started);
  return started_;
}

control_link::Parameters control_parameters() {
  return {.memory = {0, 10'000,      // markers
                     0x4000, 1'024,  // inputs
                     0x5000, 1'024,  // outputs
                     0x6000, 144,    // counters
                     0x7000, 144,    // timers
                     0x8000, 8'192,  // words
                     0xC000, 100},   // strings
          .string_bytes = kStringBytes,
          .word_memory = {0x10000, 512,   // input words
                          0x11000, 512},  // output words
          .version = 1,
          .flags = 0,
          .largest_buffer = control_link::kLargestBuffer};
}

control_link::ControlResult<control_link::Memory> read_memory(std::uint32_t address,
                                                              std::uint8_t count) {
  if (address > kMemoryEnd - count) return ControlError::BadAddress;
  return control_link::Memory{.bytes = {std::string(count, '\0')}};
}

control_link::ControlResult<DataValue> read_data_path(std::string_view path) {
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

std::string screen_dump(control_link::ProgramState state) {
  std::string bytes = "BM";
  put(bytes, kHead + kPixels);
  put(bytes, 0);
  put(bytes, kHead);
  for (const std::uint32_t value : {40U, kWidth, kHeight}) put(bytes, value);
  put(bytes, 1, 2);  // planes
  put(bytes, 1, 2);  // bits a pixel
  for (const std::uint32_t value : {0U, kPixels, 2835U, 2835U, 2U, 2U}) put(bytes, value);
  for (int entry = 0; entry < 2; ++entry) put(bytes, colour(state));
  return bytes + std::string(kPixels, '\0');
}

}  // namespace fitgauge::virtual_control

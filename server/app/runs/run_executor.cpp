#include "app/runs/run_executor.hpp"

#include "machine/simulated_machine.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

/// Moves that are kept: about 15 MB as text.
constexpr std::size_t kLongestTrace = 30'000;

/// Passes on what a run prints and remembers which block is commanding the machine.
class Follower final : public interpreter::RunObserver {
 public:
  explicit Follower(ActiveRun& active) : active_(active) {}

  void entered(const interpreter::Place& place) override { place_ = place; }
  void moved_by_cycle(int number) override { cycle_ = number; }
  void progressed(std::uint64_t blocks) override { active_.progressed(blocks); }
  void printed(std::string_view line) override { active_.printed(line); }

  /// The index of the present block among the places of the trace.
  std::int64_t place() {
    if (place_.program == nullptr) {
      if (places_.empty()) places_.emplace_back();  // a move before the first block
    } else if (places_.empty() || kept_.program != place_.program || kept_.index != place_.index ||
               places_.back().cycle != cycle_) {
      places_.push_back({std::string(place_.path()), place_.line(), place_.block(), cycle_});
      kept_ = place_;
    }
    return static_cast<std::int64_t>(places_.size()) - 1;
  }

  std::vector<RunTrace::Place> take_places() { return std::move(places_); }

 private:
  ActiveRun& active_;
  interpreter::Place place_;
  int cycle_ = 0;
  interpreter::Place kept_;  ///< the last of places_
  std::vector<RunTrace::Place> places_;
};

std::shared_ptr<const interpreter::LinkedFile> load(const RunSurroundings& surroundings,
                                                    const interpreter::ControlPath& path) {
  const auto file = surroundings.disk.find(path);
  return file ? surroundings.programs.get(*file) : nullptr;
}

std::vector<machine::Axis> axes_of(const machine::Setup& setup) {
  std::vector<machine::Axis> axes;
  for (const machine::Axis axis : machine::kAllAxes) {
    if (setup.machine.axes[machine::index(axis)]) axes.push_back(axis);
  }
  return axes;
}

}  // namespace

interpreter::RunResult unstarted(RunStatus status, MessageKind kind, std::string text,
                                 std::string program) {
  interpreter::RunResult result;
  result.status = status;
  result.messages.push_back({.kind = kind,
                             .text = std::move(text),
                             .program = std::move(program),
                             .line = 1,
                             .block = 0});  // BEGIN PGM
  return result;
}

ExecutedRun execute(const RunSurroundings& surroundings, ActiveRun& active) {
  const RunOrder& order = active.order();
  const std::string& program = active.program();
  if (active.stop_token().stop_requested()) {
    return {unstarted(RunStatus::Cancelled, MessageKind::Cancelled,
                      "the run was cancelled before its first block", program),
            {}};
  }
  const auto main = load(surroundings, order.program);
  const auto linked = main == nullptr ? nullptr : main->runnable(order.options.keeps_unreadable);
  if (linked == nullptr) {
    return {unstarted(RunStatus::Failed, MessageKind::Error,
                      "the program was deleted or replaced by one with errors before the run began",
                      program),
            {}};
  }
  Follower follower(active);
  const interpreter::RunLimits& limits = order.options.limits;
  Allowance allowance(limits.time, limits.memory_bytes, active.stop_token());
  allowance.share(main->memory_bytes);
  machine::SimulatedMachine simulated(order.setup, &allowance);
  machine::TracingMachine machine(
      simulated, {.block = [&follower] { return follower.place(); }, .longest = kLongestTrace});
  ExecutedRun executed;
  executed.result = interpreter::run(
      linked,
      {machine, surroundings.disk, surroundings.programs, surroundings.clock, follower, &allowance},
      order.options);
  executed.trace = {.moves = machine.moves(),
                    .places = follower.take_places(),
                    .axes = axes_of(order.setup),
                    .dropped = machine.dropped()};
  return executed;
}

}  // namespace fitgauge::app

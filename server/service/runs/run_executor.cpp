#include "service/runs/active_run.hpp"

#include "nc/machine/simulated_machine.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/channel.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

/// Maximum number of moves: about 50 MB as text, which is packed.
constexpr std::size_t kLongestTrace = 100'000;

/// Passes on the output of a run and remembers which block commands the machine.
class Follower final : public interpreter::RunObserver {
 public:
  Follower(ActiveRun& active, Allowance& allowance, bool shows_last)
      : active_(active), allowance_(allowance), shows_last_(shows_last) {}

  /// @param machine outlives the run.
  void follow(const machine::Machine& machine) { machine_ = &machine; }

  /// @param trace outlives the run.
  void watch(TraceWriter& trace, std::span<const klartext::QRef> names) {
    trace_ = &trace;
    watched_ = names;
  }

  bool follows_every_block() const override { return !watched_.empty(); }
  void begins(const interpreter::RunFiles& files, const interpreter::QParameters& parameters,
              const interpreter::CallStack& calls) override {
    files_ = &files;
    parameters_ = &parameters;
    calls_ = &calls;
  }
  void entered(const interpreter::Place& place) override {
    leave_block();
    place_ = place;
    answer_look();
  }
  void moved_by_cycle(int number) override { cycle_ = number; }
  void progressed(std::uint64_t blocks) override {
    active_.progressed(blocks);
    answer_look();
  }
  void reported(const interpreter::RunMessage& message) override {
    if (message.kind == MessageKind::Error) errors_.push_back(message);
  }
  void printed(std::string_view line) override { active_.printed(line); }

  void ends() override {
    leave_block();
    if (shows_last_) show(Look::StateAndFiles);
  }

  /// The block, or the cycle, that commands the machine now.
  TracePlace place() const {
    if (place_.program == nullptr) return {};  // a move before the first block
    return {place_.path(), place_.line(), place_.block(), cycle_, machine_->state().tool.number};
  }

 private:
  /// End of the block: the values of the watched parameters.
  void leave_block() {
    if (watched_.empty() || place_.program == nullptr) return;
    std::vector<interpreter::ParameterValue> values;
    for (const klartext::QRef name : watched_) {
      if (name.space == klartext::QSpace::Qs) {
        if (const auto* text = parameters_->string(name.number)) values.push_back({name, *text});
      } else if (const auto number = parameters_->number(name)) {
        values.push_back({name, *number});
      }
    }
    std::vector<klartext::DiagnosticNote> origins;
    if (left_ > 0) {
      auto chain = calls_->behind_calls();
      chain.insert(chain.begin(), place_);
      origins = interpreter::origins_of_values(chain);
      if (!origins.empty()) --left_;
    }
    trace_->add(place(), values, origins);
  }

  void answer_look() {
    if (const Look wanted = active_.wanted(); wanted != Look::Nothing) show(wanted);
  }

  void show(Look wanted) {
    // It outlives the run, and another thread frees it.
    allowance_.uncounted([&] {
      LiveState state = live();
      if (wanted == Look::StateAndFiles && files_ != nullptr) {
        state.files =
            std::make_shared<const std::vector<interpreter::WrittenFile>>(files_->copies());
      }
      active_.show(std::move(state));
      return 0;
    });
  }

  LiveState live() const {
    LiveState live{.errors = errors_};
    if (place_.program != nullptr) {
      live.program = place_.path();
      live.block = place_.block();
    }
    const machine::MachineState& state = machine_->state();
    const machine::Position position = state.position();
    for (const machine::Axis axis : machine::kAllAxes) {
      if (state.ranges[machine::index(axis)]) live.axes.emplace_back(axis, position[axis]);
    }
    live.tool = state.tool.number;
    live.tool_axis = state.tool_axis();
    live.tool_length = state.tool_length();
    live.tool_radius = state.tool_radius();
    return live;
  }

  ActiveRun& active_;
  Allowance& allowance_;
  const bool shows_last_;
  const machine::Machine* machine_ = nullptr;
  const interpreter::RunFiles* files_ = nullptr;
  const interpreter::QParameters* parameters_ = nullptr;
  const interpreter::CallStack* calls_ = nullptr;
  std::size_t left_ = 1'000;  ///< blocks that may still name their origins
  TraceWriter* trace_ = nullptr;
  std::span<const klartext::QRef> watched_;
  std::vector<interpreter::RunMessage> errors_;
  interpreter::Place place_;
  int cycle_ = 0;
};

std::vector<machine::Axis> axes_of(const machine::Setup& setup) {
  std::vector<machine::Axis> axes;
  for (const machine::Axis axis : machine::kAllAxes) {
    if (setup.machine.axes[machine::index(axis)]) axes.push_back(axis);
  }
  return axes;
}

using probing::MeasuredValue;

Measurement record_of(const RunReport& report, const interpreter::Measurement& measured,
                      const MeasuredValue& size, const std::optional<std::string>& caller) {
  Measurement record;
  record.source = Source::Simulation;
  record.measured_at = record.received_at = report.finished_at;
  record.characteristic = size.characteristic;
  const auto& [part_id, order] = report.subject;
  if (!part_id.empty()) record.part_id = part_id;
  if (!order.empty()) record.order = order;
  if (caller) record.caller = *caller;
  record.run_id = report.id;
  record.origin = report.origin;
  record.cycle = measured.record.cycle;
  const gauging::Quantity quantity =
      probing::quantity_of(measured.record.cycle, size.is_position());
  if (gauging::has_feature(quantity)) record.size_operator = "GG";
  if (const auto& form = measured.record.form; form && quantity == gauging::Quantity::Diameter) {
    record.points = static_cast<std::int64_t>(form->points);
    record.start_angle = std::llround(form->start_angle_deg * 1e6);
    record.diameter_factor = std::llround(form->diameter_factor * 1e6);
    if (form->deviation) record.form = form->deviation->count();
    if (size.uncertainty) {
      record.standard_uncertainty = size.uncertainty;
      record.rule = size.rule();
      record.coverage_factor = record.rule.coverage_factor();
    }
  }
  judge_size(record, {.quantity = quantity,
                      .feature = size.feature(),
                      .nominal = size.nominal,
                      .measured = size.measured,
                      .limits = size.limits});
  return record;
}

}  // namespace

interpreter::RunResult unstarted(RunStatus status, MessageKind kind, std::string text,
                                 std::string program) {
  interpreter::RunResult result;
  result.status = status;
  result.active_preset = 1;
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
            empty_trace(surroundings.trace)};
  }
  const auto main = surroundings.programs.get(surroundings.disk, order.program);
  const auto linked = main == nullptr ? nullptr : main->runnable(order.options.keeps_unreadable);
  if (linked == nullptr) {
    return {
        unstarted(
            RunStatus::Failed, MessageKind::Error,
            "the program was deleted, or replaced by a program with errors, before the run began",
            program),
        empty_trace(surroundings.trace)};
  }
  const interpreter::RunLimits& limits = order.options.limits;
  Allowance allowance(limits.time, limits.memory_bytes, active.stop_token());
  allowance.share(main->memory_bytes);
  Follower follower(active, allowance, surroundings.shows_last);
  std::optional<machine::SimulatedMachine> simulated;
  std::optional<machine::ScriptedMachine> scripted;
  machine::Machine* actual = nullptr;
  if (order.contacts) {
    actual = &scripted.emplace(order.setup.machine, *order.contacts, &allowance);
  } else {
    actual = &simulated.emplace(order.setup, &allowance);
  }
  TraceWriter trace(surroundings.trace, axes_of(order.setup));
  const auto keep = [&](const machine::TracedMove& move) { trace.add(move, follower.place()); };
  actual->trace(keep, kLongestTrace);
  follower.follow(*actual);
  follower.watch(trace, order.watch);
  ExecutedRun executed;
  executed.result = interpreter::run(
      linked,
      {*actual, surroundings.disk, surroundings.programs, surroundings.clock, follower, &allowance},
      order.options);
  if (scripted && scripted->remaining() > 0) {
    executed.result.messages.push_back(
        {.kind = MessageKind::Note,
         .text = fmt::format("{} of {} contacts were not used", scripted->remaining(),
                             order.contacts->size()),
         .program = program,
         .line = 1,
         .block = 0});
  }
  executed.trace = trace.finish(actual->untraced());
  return executed;
}

std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller) {
  std::vector<Measurement> records;
  for (const interpreter::Measurement& measured : report.result.measurements) {
    const auto& sizes = measured.record.sizes;
    const auto is_judged = [](const MeasuredValue& size) { return size.limits.has_value(); };
    const bool judges = std::ranges::any_of(sizes, is_judged);
    for (const MeasuredValue& size : sizes) {
      // A place without limits is the result only of a cycle that measures no size.
      const bool is_result = !judges && &size == &sizes.front();
      if (size.is_position() && !is_judged(size) && !is_result) continue;
      records.push_back(record_of(report, measured, size, caller));
    }
  }
  return records;
}

}  // namespace fitgauge::app

#include "nc/program/diagnose.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::CycleValue;

/// Reports to the observer which cycle commands the machine during its lifetime.
class MovedByCycle {
 public:
  MovedByCycle(Channel& channel, int number) : observer_(channel.environment.observer) {
    observer_.moved_by_cycle(number);
  }
  MovedByCycle& operator=(MovedByCycle&&) = delete;  // neither copied nor moved
  ~MovedByCycle() { observer_.moved_by_cycle(0); }

 private:
  RunObserver& observer_;
};

/// The interface of touch-probe cycles to the program. Results go to Q parameters in the unit of
/// the current program. Failures of functions without a result are stored for
/// `failure`.
class ChannelCycleHost final : public probing::CycleHost {
 public:
  explicit ChannelCycleHost(Channel& channel) : channel_(channel) {}

  void set_q(std::uint16_t number, double value, probing::Unit unit) override {
    const double scaled = value / scale_of(unit, block_is_inch());
    keep(channel_.parameters.set({QSpace::Q, number}, scaled));
  }

  probing::CycleMemory& memory() override { return channel_.cycle_memory; }
  bool log_is_inch() const override { return channel_.calls.main_program().is_inch(); }
  bool block_is_inch() const override { return channel_.linked().is_inch(); }
  std::string_view program_path() const override { return channel_.linked().path().text(); }
  Timestamp now() const override { return channel_.now(); }

  probing::CycleResult<void> append_log(std::string_view name, std::string_view text) override {
    const auto path = channel_.resolve_printed(name);
    return reported(path ? channel_.files.append(*path, text) : path.error());
  }

  probing::CycleResult<void> write_log(std::string_view name, std::string_view text) override {
    const auto path = channel_.resolve_printed(name);
    return reported(path ? channel_.files.write(*path, std::string(text)) : path.error());
  }

  void stop(std::string_view reason) override {
    channel_.machine().stop(reason);
    if (channel_.options.on_stop == OnStop::End) {
      channel_.stop_after_block = true;
    } else {
      keep(channel_.log.report(MessageKind::Stop, 0, std::string(reason), channel_.place()));
    }
  }

  probing::CycleResult<bool> confirm(std::string_view reason) override {
    stop(reason);
    return channel_.options.on_stop != OnStop::End;
  }

  probing::CycleResult<void> note(std::string_view text) override {
    return reported(channel_.note(std::string(text)));
  }

  void show_and_stop(std::string_view text) override {
    while (!text.empty()) keep(channel_.log.print(std::string(take_field(text, '\n'))));
    stop("measuring log shown on the screen");
  }

  void record(const probing::MeasuringRecord& record) override {
    keep(channel_.log.record(record, channel_.chain()));
  }

  void touched(const machine::ContactPoint& contact) override { channel_.last_touch = contact; }

  probing::CycleResult<void> write_datum(int row, const AxisWords& values) override {
    return reported(channel_.tables.write_datum(row, values));
  }

  probing::CycleResult<probing::KinematicsRecords> kinematics_records() override {
    return read_kinematics_records(channel_.files, channel_.budget.allowance());
  }

  probing::CycleResult<void> keep_kinematics(const probing::KinematicsRecords& records) override {
    return reported(write_kinematics_records(channel_.files, records));
  }

  /// The first failure that the cycle did not report, or nothing.
  const std::optional<NcError>& failure() const { return failure_; }

 private:
  probing::CycleResult<void> reported(NcResult<void> done) {
    keep(done);
    return done;
  }

  void keep(const NcResult<void>& done) {
    if (!done && !failure_) failure_ = done.error();
  }

  Channel& channel_;
  std::optional<NcError> failure_;
};

/// A travel that ends before the nominal contact finds only nearer material.
NcResult<void> note_short_travel(Channel& channel, const Arguments& arguments) {
  const auto probe = channel.state().probe_system();
  if (!probe || arguments.descriptor().find(probing::q(320)) == nullptr) return {};
  const double clearance = probe->data.set_up + arguments.number(320);
  if (probe->data.distance >= clearance) return {};
  return channel.note(
      "DIST ({} mm) is shorter than SET_UP + Q320 ({} mm): the probe stops before the "
      "nominal surface",
      probe->data.distance, clearance);
}

NcResult<void> run_probing(Channel& channel, const TouchProbeCycle& cycle, Arguments arguments) {
  TRY(arguments.complete());
  TRY(note_short_travel(channel, arguments));
  channel.active_cycle.last_probing = cycle.descriptor.number;
  const MovedByCycle moved(channel, cycle.descriptor.number);
  ChannelCycleHost host(channel);
  auto done = probing::run_cycle(cycle, std::move(arguments), channel.machine(), host);
  if (host.failure()) return *host.failure();
  return done;
}

/// GLOBAL DEF: its values apply until the next one of its number, or the end of the run.
NcResult<void> define_globally(Channel& channel, const klartext::Cycle& cycle,
                               const BoundCycle& bound) {
  auto arguments = TRY(cycle_arguments(channel, cycle, bound));
  TRY(arguments.complete());
  for (const CycleParameter& parameter : bound.global->parameters)
    channel.predefined[static_cast<int>(parameter.id)] = arguments.number(parameter.id);
  return {};
}

/// Stores the cycle for M99 and CYCL CALL, or runs it at once if it is DEF-active.
NcResult<void> define(Channel& channel, MachiningDefinition definition) {
  ActiveCycle& active = channel.active_cycle;
  const MachiningShape shape = definition.cycle->shape;
  if (shape == MachiningShape::ContourData) {
    TRY(check_values(definition));
    active.contour_data = std::move(definition);
    return {};
  }
  if (definition.cycle->runs_when_defined) {
    const MovedByCycle moved(channel, definition.cycle->descriptor.number);
    return run_pattern(channel, definition);
  }
  active.number = definition.cycle->descriptor.number;
  active.definition = std::move(definition);
  return {};
}

/// A cycle that only the builder of the machine knows.
NcResult<Next> run_builders(Channel& channel, klartext::CycleFamily family, int number) {
  if (family == klartext::CycleFamily::GlobalDef)
    return nc_error("cycle GLOBAL DEF {} is not available", number);
  const BuilderAction* action = channel.options.builder.cycle(number);
  if (action == nullptr)
    return nc_error(cycle_hint(family == klartext::CycleFamily::TchProbe, number));
  if (action->program) return call_program(channel, *action->program);
  channel.active_cycle.definition = IgnoredCycle{};
  return Next{};
}

/// Its parameters become Q parameters of its replacement program.
NcResult<void> set_parameters(Channel& channel, const klartext::Cycle& cycle) {
  for (const auto& written : channel.program().view(cycle.parameters)) {
    if (written.kind != CycleValue::Expression || written.parameter.is_string()) continue;
    const auto value = TRY(number(channel, written.value));
    TRY(channel.parameters.set(written.parameter, value));
  }
  return {};
}

/// CYCL CALL POS moves there in the working plane. Its coordinate along the tool axis shifts the
/// cycle like a datum. Old cycles, which begin at the present height, and programs also move along
/// the tool axis.
NcResult<Next> call_at_position(Channel& channel, const MotionWords& words) {
  TRY(channel.contour.finish(channel.machine()));
  AxisWords target;
  for (const Axis axis : kAllAxes) {
    const auto& word = words.axes[index(axis)];
    if (word) target[axis] = word->after(channel.machine().position()[axis]);
  }
  auto* machining = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
  const double surface = machining == nullptr ? 0 : machining->value(203);
  const bool is_shifted = machining != nullptr && !machining->cycle->descriptor.dotted;
  if (is_shifted) {
    auto& height = target[channel.state().tool_axis()];
    machining->values[203] = surface + height.value_or(0);
    height.reset();
    ToolMotion motion(channel.machine(), channel.budget);
    const double clearance = machining->value(203) + machining->value(200);
    if (motion.height() < machining->value(203)) TRY(motion.to_height(clearance, Feed::rapid()));
  }
  const auto feed = words.feed.value_or(Feed::rapid());
  const auto moved = channel.machine().move({target, feed});
  auto next = moved ? call_active_cycle(channel) : moved.error();
  if (is_shifted) machining->values[203] = surface;
  return next;
}

}  // namespace

NcResult<Next> execute(Channel& channel, const klartext::Cycle& cycle, const BoundCycle& bound) {
  if (bound.probing != nullptr) {
    auto arguments = TRY(cycle_arguments(channel, cycle, bound));
    TRY(run_probing(channel, *bound.probing, std::move(arguments)));
  } else if (bound.machining != nullptr) {
    auto definition = TRY(machining_arguments(channel, cycle, bound));
    TRY(define(channel, std::move(definition)));
  } else if (bound.global != nullptr) {
    TRY(define_globally(channel, cycle, bound));
  } else {
    if (channel.options.builder.cycle(cycle.number) != nullptr) TRY(set_parameters(channel, cycle));
    return run_builders(channel, cycle.family, cycle.number);
  }
  return Next{};
}

NcResult<Next> execute_parts(Channel& channel, std::uint32_t first, std::uint32_t last) {
  const auto& opening = std::get<klartext::CyclePart>(channel.program().blocks()[first].statement);
  if (!is_available(opening.family, opening.number, true))
    return run_builders(channel, opening.family, opening.number);
  if (const auto* probing = find_cycle(opening.family, opening.number)) {
    auto arguments = TRY(dotted_arguments(channel, *probing, first, last));
    TRY(run_probing(channel, *probing, std::move(arguments)));
  } else if (opening.number == 14) {
    channel.active_cycle.contours = TRY(contour_labels(channel, first, last));
  } else if (const auto* machining = machining_cycle(opening.number)) {
    auto definition = TRY(machining_arguments(channel, *machining, first, last));
    TRY(define(channel, std::move(definition)));
  } else {
    std::vector<Word> words;
    for (const auto& [part, word] : words_of_parts(channel, first, last)) words.push_back(word);
    TRY(execute_transformation(channel, opening.number, words));
  }
  return Next{};
}

NcResult<Next> call_active_cycle(Channel& channel) {
  const auto& definition = channel.active_cycle.definition;
  if (const auto* program = std::get_if<ControlPath>(&definition))
    return call_program(channel, *program);
  if (std::holds_alternative<IgnoredCycle>(definition)) return Next{};
  const auto* machining = std::get_if<MachiningDefinition>(&definition);
  if (machining == nullptr) return nc_error(1027);
  TRY(channel.contour.finish(channel.machine()));
  const MovedByCycle moved(channel, channel.active_cycle.number);
  TRY(machine_here(channel, *machining));
  return Next{};
}

NcResult<Next> execute(Channel& channel, const klartext::CycleCall& call) {
  const auto words = TRY(read_words(channel, call.words));
  TRY(start_m_functions(channel, words.m));
  if (call.kind == klartext::CycleCallKind::Pattern) {
    {
      const MovedByCycle moved(channel, channel.active_cycle.number);
      TRY(run_points(channel));
    }
    return end_m_functions(channel, words);
  }
  const bool is_at_position = call.kind == klartext::CycleCallKind::Position;
  auto next = is_at_position ? call_at_position(channel, words) : call_active_cycle(channel);
  if (!next || next->kind != Next::Kind::Block) return next;
  return end_m_functions(channel, words);
}

}  // namespace fitgauge::interpreter

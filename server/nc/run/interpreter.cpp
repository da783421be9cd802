#include "nc/run/interpreter.hpp"

#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

/// Sets parameters as if an earlier program had set them.
NcResult<void> preset(QParameters& parameters, const std::vector<ParameterValue>& values) {
  for (const auto& [parameter, value] : values) {
    const auto* number = std::get_if<double>(&value);
    TRY(number != nullptr ? parameters.set(parameter, *number)
                          : parameters.set_string(parameter.number, std::get<std::string>(value)));
  }
  return {};
}

/// Ends a run, even after an error: writes the collected output.
NcResult<void> close_files(Channel& channel) {
  auto printed = channel.printer.close();
  auto tables = channel.tables.close();
  channel.cycle_memory.end_program();
  return printed ? tables : printed;
}

}  // namespace

RunResult run(std::shared_ptr<const LinkedProgram> main, const RunEnvironment& environment,
              const RunOptions& options, std::stop_token stop) {
  Allowance own(options.limits.time, options.limits.memory_bytes, std::move(stop));
  Allowance& allowance = environment.allowance != nullptr ? *environment.allowance : own;
  Channel channel(std::move(main), environment, options, allowance);
  environment.observer.begins(channel.files, channel.parameters, channel.calls);
  channel.parameters.enter(channel.linked());
  Ending ending;
  auto ready = preset(channel.parameters, options.parameters);
  if (ready && options.datum_table) ready = channel.tables.select_datum_table(*options.datum_table);
  if (!ready) {
    ending.error = ready.error();
  } else {
    ending = execute_program(channel);
  }
  const Place last = channel.place();
  auto closed = close_files(channel);
  if (!ending.error && !closed) ending.error = closed.error();
  // An interrupted move or loop has failed for that reason, whatever its error.
  if (auto refusal = channel.budget.refusal()) ending.error = std::move(refusal);

  RunResult result;
  result.blocks_executed = ending.blocks_executed;
  if (ending.error) {
    constexpr RunStatus kStatuses[] = {RunStatus::Failed, RunStatus::Stopped,
                                       RunStatus::LimitExceeded, RunStatus::Cancelled};
    static_assert(std::size(kStatuses) == static_cast<std::size_t>(FaultKind::Cancelled) + 1);
    const FaultKind kind = ending_of(ending.error->kind);
    result.status = kStatuses[static_cast<std::size_t>(kind)];
    std::vector<DiagnosticNote> origins;
    if (kind == FaultKind::Error) {
      origins = origins_of(channel.chain(), *ending.error);
    } else if (kind == FaultKind::Stop && ending.error->number != 0) {
      origins = origins_of_values(channel.chain());
    }
    channel.log.finish(*ending.error, last, std::move(origins));
  }
  environment.observer.ends();
  // Reports the QL of the main program, even if the run ended in another program.
  while (!channel.calls.is_in_main()) {
    const CallStack::Caller caller = channel.calls.return_from_program();
    channel.parameters.enter(channel.linked(), caller.locals);
  }
  result.parameters = channel.parameters.all();
  result.files = channel.files.take();
  result.tables = channel.tables.opened();
  channel.log.take(result);
  const MachineState& state = environment.machine.state();
  result.machining_time_s = state.elapsed_s;
  result.active_preset = state.active_preset;
  for (const auto& [number, row] : state.presets.rows()) result.presets.push_back(row);
  return result;
}

Channel::Channel(std::shared_ptr<const LinkedProgram> main, const RunEnvironment& run_environment,
                 const RunOptions& run_options, Allowance& allowance)
    : environment(run_environment),
      options(run_options),
      budget(run_options.limits, allowance),
      output(run_options.limits.output_bytes),
      log(output, run_environment.observer),
      files(run_environment.disk, output, run_options.limits.files),
      calls(std::move(main)),
      printer(files, output),
      tables(files, parameters, allowance) {}

std::vector<Place> Channel::chain() const {
  std::vector<Place> all = calls.behind_calls();
  const bool is_jumped_to = before.program == &linked() &&
                            place().source().is<klartext::ErrorStop>() &&
                            before.source().is<klartext::ConditionalJump>();
  all.insert(all.begin(), is_jumped_to ? before : place());
  return all;
}

NcResult<void> Channel::programmed_stop(std::string reason) {
  machine().stop(reason);
  if (options.on_stop == OnStop::End) return NcError{FaultKind::Stop, 0, std::move(reason)};
  return log.report(MessageKind::Stop, 0, std::move(reason), place());
}

NcResult<ControlPath> Channel::resolve(std::string_view written) const {
  auto path = ControlPath::resolve(written, linked().path());
  return path ? NcResult<ControlPath>(*std::move(path)) : nc_error(path.error());
}

NcResult<ControlPath> Channel::resolve_printed(std::string_view written) const {
  const bool is_name = written.find_first_of("\\/:") == std::string_view::npos;
  if (!is_name || !options.print_folder) return resolve(written);
  auto path = ControlPath::resolve(written, *options.print_folder);
  return path ? NcResult<ControlPath>(*std::move(path)) : nc_error(path.error());
}

NcResult<ControlPath> Channel::resolve_program(std::string_view written) const {
  auto path = TRY(resolve(written));
  return path.with_default_extension(program_extension(linked().path()));
}

NcResult<std::shared_ptr<const LinkedProgram>> Channel::load_program(const ControlPath& path) {
  const auto missing = [&] { return nc_error("program {} does not exist", path.text()); };
  const auto revision = files.revision(path);
  if (!revision) return missing();
  std::shared_ptr<const LinkedProgram>& known = loaded_[path.key() + '|' + *revision];
  if (known != nullptr) return known;
  Allowance& allowance = budget.allowance();
  const auto linked = allowance.uncounted([&] { return environment.programs.get(files, path); });
  if (linked == nullptr) return missing();
  allowance.share(linked->memory_bytes);
  TRY(budget.check());
  const auto& program = linked->runnable(options.keeps_unreadable);
  if (program == nullptr) {
    const auto first =
        std::ranges::find(linked->diagnostics, Severity::Error, &Diagnostic::severity);
    return nc_error("program {} has errors, the first in line {}: {}", path.text(),
                    first->range.begin.line, first->message);
  }
  return known = program;
}

std::vector<Place> CallStack::behind_calls() const {
  std::vector<Place> all;
  const auto add = [&](const LinkedProgram& program, std::uint32_t instruction) {
    // A cycle that runs a subprogram has no such instruction.
    if (instruction < program.code().size())
      all.push_back({&program, program.block_of(instruction)});
  };
  std::size_t label = label_returns_.size();
  for (std::size_t i = programs_.size(); i-- > 0;) {
    while (label > programs_[i].first_label) add(*programs_[i].program, label_returns_[--label]);
    if (i > 0) add(*programs_[i - 1].program, programs_[i].caller.return_to);
  }
  return all;
}

NcResult<void> CallStack::call_label(std::uint32_t return_to) {
  if (label_returns_.size() >= kMostNested)
    return nc_error(1025, "more than {} subprograms call each other", kMostNested);
  label_returns_.push_back(return_to);
  return {};
}

std::optional<std::uint32_t> CallStack::return_from_label() {
  if (label_returns_.size() == programs_.back().first_label) return std::nullopt;
  const std::uint32_t target = label_returns_.back();
  label_returns_.pop_back();
  return target;
}

NcResult<void> CallStack::call_program(std::shared_ptr<const LinkedProgram> program,
                                       Caller caller) {
  if (programs_.size() > kMostNested)
    return nc_error(1025, "more than {} programs call each other", kMostNested);
  programs_.push_back({std::move(program), std::move(caller), label_returns_.size()});
  return {};
}

CallStack::Caller CallStack::return_from_program() {
  Activation ended = std::move(programs_.back());
  programs_.pop_back();
  label_returns_.resize(ended.first_label);
  return std::move(ended.caller);
}

}  // namespace fitgauge::interpreter

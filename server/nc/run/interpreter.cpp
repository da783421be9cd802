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

}  // namespace fitgauge::interpreter

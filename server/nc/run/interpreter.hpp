#pragma once

#include "nc/klartext/mask_file.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/run_log.hpp"

namespace fitgauge::interpreter {

/// The replacement of an M function or cycle of the machine builder: a program, or nothing.
struct BuilderAction {
  std::optional<ControlPath> program;
};

/// M functions and cycles of the machine builder, as in the setup (decision 28). Functions of the
/// control itself cannot be replaced.
struct MachineBuilder {
  std::map<int, BuilderAction> m_functions;
  std::map<int, BuilderAction> cycles;

  const BuilderAction* m_function(int number) const { return find(m_functions, number); }
  const BuilderAction* cycle(int number) const { return find(cycles, number); }

 private:
  static const BuilderAction* find(const std::map<int, BuilderAction>& actions, int number) {
    const auto it = actions.find(number);
    return it == actions.end() ? nullptr : &it->second;
  }
};

/// The action at STOP, M0, M1 and Q281 = 2: the run continues as after NC Start, or ends.
enum class OnStop : std::uint8_t { Continue, End };

struct RunOptions {
  std::vector<ParameterValue> parameters;  ///< set before block 0; each valid for `validate`
  RunLimits limits;
  OnStop on_stop = OnStop::Continue;
  bool block_skip = false;  ///< blocks that begin with `/` are passed over
  /// The first block of the main program that runs, by its number, as after GOTO on a control:
  /// nothing before it has run. @pre the program has it
  std::optional<std::uint32_t> start_block{};
  MachineBuilder builder;  ///< M functions and cycles that the control does not know
  /// Lines that are no Klartext are ERROR blocks, which fail when they are reached (decision 32);
  /// otherwise they refuse the program.
  bool keeps_unreadable = false;
  bool decimal_comma = true;  ///< of FN 15
  /// Any file in the folder for logs and for files of FN 16 without a folder (fn16DefaultPath).
  /// None: the program's folder is used.
  std::optional<ControlPath> print_folder;
  /// The datum table that is active at the start, until SEL TABLE.
  std::optional<ControlPath> datum_table;
  klartext::MaskLanguage language = klartext::MaskLanguage::English;  ///< of the control's dialog
};

/// The input of a run. All must outlive the run; machine and observer must not be shared with other
/// runs.
struct RunEnvironment {
  machine::Machine& machine;
  const ControlDisk& disk;
  ProgramCache& programs;
  const Clock& clock;
  RunObserver& observer;
  /// Made of the limits and the stop token before the machine, which checks it too; without it the
  /// run makes one, and the machine is not interrupted.
  Allowance* allowance = nullptr;
};

/// Runs a program to its end, on the calling thread.
///
/// To run a file: `check` it and refuse the run when an error is among the diagnostics; build a
/// machine from the setup; then
///
///     const auto file = programs.get(*disk.find(path));
///     RunResult result = run(file->program, {machine, disk, programs, clock, observer}, options,
///                            stop_source.get_token());
///
/// Never throws for what a program does: NC errors, machine faults, budgets and cancellation are
/// in the result, whose last message then names the block. Broken storage (ControlDisk) passes
/// through as an exception. Cancel with the stop token from any thread: it is seen within a few
/// thousand blocks of formulas, and inside of every block that can last. Files the run writes are
/// in the result only.
/// @param stop unused where the environment brings an allowance
RunResult run(std::shared_ptr<const LinkedProgram> main, const RunEnvironment& environment,
              const RunOptions& options, std::stop_token stop = {});

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/machine/machine_state.hpp"
#include "nc/probing/measuring_record.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::interpreter {

/// End of a run; the words of the HTTP contract.
enum class RunStatus : std::uint8_t { Completed, Stopped, Failed, LimitExceeded, Cancelled };

/// `completed`, `stopped`, `failed`, `limit_exceeded`, `cancelled`.
std::string_view word(RunStatus status);

/// The first in the order of machine::FaultKind.
enum class MessageKind : std::uint8_t {
  Error,      ///< of the NC program or the machine; the run failed
  Stop,       ///< STOP, M0, a log on the screen, the Q309 reaction of a cycle
  Limit,      ///< a budget of the run is used up
  Cancelled,  ///< by the operator
  Note,       ///< omitted by the simulation: radius compensation, PLC functions
};

/// `error`, `stop`, `limit`, `cancelled`, `note`.
std::string_view word(MessageKind kind);

/// A line for the control's message line, and its block.
struct RunMessage {
  MessageKind kind = MessageKind::Error;
  int number = 0;  ///< the control's error number, 0 if it has none
  std::string text;
  std::string program;                 ///< TNC:\...
  std::uint32_t line = 0;              ///< from 1, of the block's first physical line
  std::optional<std::uint32_t> block;  ///< its number, as written or counted
  std::uint32_t column = 0;            ///< from 1, of the block in that line; 0: no line is meant
  std::string source{};                ///< the physical line, cut if it is long
  std::vector<DiagnosticNote> origins{};  ///< of what ended the run

  friend bool operator==(const RunMessage&, const RunMessage&) = default;
};

/// A file the run wrote.
struct WrittenFile {
  ControlPath path;
  std::string bytes;
};

/// A table the run opened.
struct OpenedTable {
  ControlPath path;
  FileSource source = FileSource::Stored;
};

/// The result of a measuring cycle, and its place in the program.
struct Measurement {
  probing::MeasuringRecord record;
  std::string program;
  std::uint32_t line = 0;
  std::optional<std::uint32_t> block;
  std::vector<DiagnosticNote> origins{};  ///< of the first kMostFindings
};

/// All results of a run; complete also if it failed.
struct RunResult {
  RunStatus status = RunStatus::Completed;
  std::uint64_t blocks_executed = 0;
  double machining_time_s = 0;
  /// Verdict of the last measuring cycle that has a status (444: from Q183; none for -1).
  std::optional<gauging::Verdict> verdict;
  /// Every Q, QR and QS and the main program's QL that is defined at the end, in that order.
  std::vector<ParameterValue> parameters;
  std::vector<std::string> screen;  ///< every line printed, in order
  std::vector<WrittenFile> files;
  std::vector<OpenedTable> tables;
  std::vector<RunMessage> messages;
  std::vector<Measurement> measurements;
  int active_preset = 0;
  std::vector<machine::Preset> presets;
};

/// The findings of a run on a setup: an error that ended it, its notes, a note for a cycle that
/// stopped it at a limit, and a warning for every size or centre of a bore, stud, slot or ridge
/// that is measured more than 0.5 mm from its nominal.
std::vector<Diagnostic> findings_of(const RunResult& result);

class CallStack;
class LinkedProgram;
class QParameters;
class RunFiles;

/// A block of a running program.
struct Place {
  const LinkedProgram* program = nullptr;
  std::uint32_t index = 0;  ///< of the block

  std::string_view path() const;
  std::uint32_t line() const;
  /// Its number, as written or counted.
  std::uint32_t block() const;
  const klartext::Block& source() const;
};

/// An observer of a run; called on the run's thread, so it must not block.
class RunObserver {
 public:
  RunObserver& operator=(RunObserver&&) = delete;  // neither copied nor moved
  virtual ~RunObserver() = default;

  /// Asked once at the start: true if `entered` is needed for every block, false if only for blocks
  /// that may command the machine or print.
  virtual bool follows_every_block() const { return false; }
  /// Called once before the first block with the run's files, parameters and calls, which may be
  /// read in the calls below.
  virtual void begins(const RunFiles&, const QParameters&, const CallStack&) {}
  /// Called before a block: machine commands until the next call belong to it.
  virtual void entered(const Place&) {}
  /// The cycle that commands the machine from now on; 0: the blocks themselves.
  virtual void moved_by_cycle(int /*number*/) {}
  /// Now and then, with the blocks executed so far.
  virtual void progressed(std::uint64_t /*blocks*/) {}
  virtual void printed(std::string_view /*screen_line*/) {}
  virtual void reported(const RunMessage&) {}
  /// The run is over and its files are closed; the last call, and the files are still there.
  virtual void ends() {}
};

}  // namespace fitgauge::interpreter

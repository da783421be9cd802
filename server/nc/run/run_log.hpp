#pragma once

#include "base/allowance.hpp"
#include "nc/machine/machine_state.hpp"
#include "nc/probing/cycle_host.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::interpreter {

using machine::FaultKind;
using NcError = machine::MachineFault;
template <class T>
using NcResult = machine::MachineResult<T>;

using probing::nc_error;  // of the control's list: "Touch point inaccessible: detail"
/// An error of the program without a number of the control's.
inline NcError nc_error(std::string text) { return {FaultKind::Error, 0, std::move(text)}; }
template <class First, class... Rest>
NcError nc_error(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  return nc_error(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}
template <class... Parts>
NcError limit_error(fmt::format_string<Parts...> text, Parts&&... parts) {
  return {FaultKind::Limit, 0, fmt::format(text, std::forward<Parts>(parts)...)};
}
/// A missing row, a path outside the disk and the like.
inline NcError nc_error(const Error& error) {
  return nc_error(error.where.empty() ? error.message : error.where + ": " + error.message);
}

/// The end that an error gives a run: Error, Stop, Limit or Cancelled.
constexpr FaultKind ending_of(FaultKind kind) {
  return kind > FaultKind::Cancelled ? FaultKind::Error : kind;
}

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

/// Budget of one run. A run above one of these limits ends with LimitExceeded.
struct RunLimits {
  std::uint64_t blocks = 1'000'000;
  std::chrono::duration<double> time{10.0};         ///< of the wall clock
  std::size_t output_bytes = std::size_t{4} << 20;  ///< screen, files, messages and records
  std::size_t files = 100;                          ///< written
  /// Memory of the run: programs, tables, masks, presets, files, records, its trace.
  std::size_t memory_bytes = std::size_t{48} << 20;
};

/// The blocks of a run, and its allowance of time and memory. The executor reserves blocks in
/// portions and counts them itself; the allowance is checked with each portion, with each block
/// that is more than arithmetic, and in every loop inside of such a block.
class RunBudget {
 public:
  /// @param allowance is also that of the run's machine, and must outlive the budget
  RunBudget(const RunLimits& limits, Allowance& allowance)
      : limits_(limits), allowance_(allowance) {}

  /// Returns the rest of a portion and reserves a new one of at least `needed` blocks.
  /// @errors limit (blocks, time), cancelled.
  NcResult<std::int64_t> refuel(std::int64_t left, std::int64_t needed);
  /// The rest of a portion if its executor ends before the run.
  void give_back(std::int64_t left) { granted_ -= static_cast<std::uint64_t>(left); }
  /// Checks the budget. Call it in loops, and for each block that is more than arithmetic.
  /// @errors limit (time, memory), cancelled.
  NcResult<void> check() {
    if (!allowance_.is_spent()) [[likely]]
      return {};
    return *refusal();
  }
  /// Returns the refusal of an earlier check, if the allowance is spent: it is the cause of later
  /// failures.
  std::optional<NcError> refusal() const;

  Allowance& allowance() { return allowance_; }

  /// @param left of the last portion.
  std::uint64_t executed(std::int64_t left) const {
    return granted_ - static_cast<std::uint64_t>(left);
  }

 private:
  static constexpr std::int64_t kPortion = 8192;

  const RunLimits limits_;
  Allowance& allowance_;
  std::uint64_t granted_ = 0;
};

/// The rest of the run's output budget; every stored text is charged to it.
class OutputBudget {
 public:
  explicit OutputBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}
  /// @errors limit when it is used up; nothing is charged then.
  NcResult<void> charge(std::size_t bytes);
  std::size_t left() const { return left_; }

 private:
  std::size_t total_;
  std::size_t left_;
};

/// The output of a run: screen, messages, measurements. Owns them until they are moved out.
class RunLog {
 public:
  RunLog(OutputBudget& budget, RunObserver& observer) : budget_(budget), observer_(observer) {}

  /// A line of the screen window. @errors limit.
  NcResult<void> print(std::string line);
  /// A message that does not end the run. @errors limit.
  NcResult<void> report(MessageKind kind, int number, std::string text, const Place& place);
  /// Something the simulation leaves out: reported the first time only. @errors limit.
  NcResult<void> note(std::string text, const Place& place);
  /// The message of the error that ends the run; not charged, so that it is always there.
  void finish(const NcError& error, const Place& place, std::vector<DiagnosticNote> origins);
  /// @param chain as of origins_of_values. @errors limit.
  NcResult<void> record(probing::MeasuringRecord record, std::span<const Place> chain);

  void take(RunResult& result);

 private:
  void add(MessageKind kind, int number, std::string text, const Place& place);

  OutputBudget& budget_;
  RunObserver& observer_;
  std::vector<std::string> screen_;
  std::vector<RunMessage> messages_;
  std::vector<Measurement> measurements_;
  std::set<std::string, std::less<>> notes_;
};

// origins.cpp
/// Returns the blocks that a failing block depends on, each with its effect: on the parameters that
/// the failing block reads, on the parameters these were computed from, and, if the error can come
/// from them, on axes that it does not move, datum, tool and unit INCH. Names for each the block
/// that ran last before it, as far as the calls of subprograms tell this.
/// @param chain the failing block, then the blocks after the calls that lead to it
std::vector<DiagnosticNote> origins_of(std::span<const Place> chain, const NcError& error);

/// The blocks that the values of a block depend on, if it measures or reads data of the control.
std::vector<DiagnosticNote> origins_of_values(std::span<const Place> chain);

/// The control's disk after this run: its files cover the stored ones, and stay in the run. Not
/// thread-safe.
class RunFiles final : public ControlDisk {
 public:
  /// @param disk must outlive this object, as must `budget`.
  RunFiles(const ControlDisk& disk, OutputBudget& budget, std::size_t most_files)
      : disk_(disk), budget_(budget), most_files_(most_files) {}

  std::optional<ControlFile> find(const ControlPath& path) const override;
  /// Revision of the file of `find`, without reading its bytes.
  std::optional<std::string> revision(const ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

  /// Counts a file that will be written later. @errors limit: number of files.
  NcResult<void> reserve(const ControlPath& path);
  /// @errors limit: output or number of files.
  NcResult<void> write(const ControlPath& path, std::string bytes);
  /// Appends to a file of the run, or to a copy of the stored file. @errors as write.
  NcResult<void> append(const ControlPath& path, std::string_view bytes);

  /// Copies of all that was written until now.
  std::vector<WrittenFile> copies() const;
  std::vector<WrittenFile> take();

 private:
  struct Written {
    ControlPath path;
    std::shared_ptr<std::string> bytes;  ///< not to be changed while others have found the file
    unsigned revision = 0;

    std::string revision_text() const { return "run-" + std::to_string(revision); }
  };

  const ControlDisk& disk_;
  OutputBudget& budget_;
  std::size_t most_files_;
  std::set<std::string> reserved_;          // keys of all that is or will be written
  std::map<std::string, Written> written_;  // by key
};

// kinematics_records.cpp
/// Reads the records of cycle 450 in `TNC:\table\DATA450.KD`: a row for each axis of a record and
/// one for the tool, with a point and a direction. None without this file.
/// @errors 1096 the file is not such a table.
NcResult<probing::KinematicsRecords> read_kinematics_records(const RunFiles& files,
                                                             Allowance& allowance);

/// Replaces that file. @errors as RunFiles::write.
NcResult<void> write_kinematics_records(RunFiles& files, const probing::KinematicsRecords& records);

}  // namespace fitgauge::interpreter

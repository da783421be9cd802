#pragma once

#include "base/gzip.hpp"
#include "db/store/runs_store.hpp"
#include "nc/machine/machine.hpp"
#include "nc/machine/scripted_machine.hpp"
#include "nc/run/interpreter.hpp"
#include "record/measurement.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

struct ControlTables;

/// The part of a run, for its records; empty: unknown.
struct RunSubject {
  std::string part_id{};
  std::string order{};
};

/// The order of a run.
struct RunOrder {
  interpreter::ControlPath program;
  machine::Setup setup;  ///< validated
  interpreter::RunOptions options;
  std::string request;  ///< stored with the run, so that it can be repeated
  /// Contacts of each probing move of a real machine, in order; absent: the machine is simulated.
  std::optional<std::vector<machine::ScriptedContact>> contacts{};
  RunSubject subject{};
  std::optional<std::string> caller{};
  std::string setup_name{};  ///< name of its stored setup; empty: a setup in the request
  /// Parameters whose values after each block are in the trace.
  std::vector<klartext::QRef> watch{};

  /// Whether the file is its program or a mesh of its setup.
  bool names(const interpreter::ControlPath& file) const;
};

using RunState = store::RunStatus;
/// Without Cancelling, which the outside sees as running.
inline constexpr auto kRunStates = static_cast<std::size_t>(RunState::Cancelling);

/// Reads `queued`, `running`, `completed`, ...
constexpr std::optional<RunState> run_state_from_word(std::string_view text) {
  return enum_of<RunState>(text, store::kRunWords);
}
RunState state_of(interpreter::RunStatus status);

/// A run that is over.
struct RunReport {
  std::int64_t id = 0;
  std::string_view origin{};  ///< of the data folder
  std::string program;
  interpreter::RunResult result{};
  std::uint64_t seed = 1;
  RunSubject subject{};
  Timestamp created_at{};
  Timestamp finished_at{};

  std::string id_text() const { return run_id_text(id, origin); }
};

/// Whose move it is.
struct TracePlace {
  std::string_view program{};
  std::uint32_t line = 0;
  std::optional<std::uint32_t> block{};  ///< its number as written
  int cycle = 0;                         ///< that commands the machine, 0 for the block itself
  int tool = 0;                          ///< in the spindle, 0 without one
};

/// Blocks of a watched run, as text.
struct WatchedBlocks {
  static constexpr std::size_t kLongest = std::size_t{4} << 20;
  std::string text{};       ///< at most kLongest bytes
  std::size_t dropped = 0;  ///< blocks that came after that
};

/// Writes the moves of a run one by one while it moves.
struct TraceFormat {
  std::string_view head{};
  std::string_view separator{};  ///< between two moves
  /// @param axes that the machine has
  std::function<void(std::string& out, const machine::TracedMove&, const TracePlace&,
                     std::span<const machine::Axis> axes)>
      move{};
  /// A block that has run, with the defined watched parameters.
  /// @param moves of the run until then
  /// @param origins blocks that its values come from
  std::function<void(std::string& out, const TracePlace&, std::size_t moves,
                     std::span<const interpreter::ParameterValue> values,
                     std::span<const klartext::DiagnosticNote> origins)>
      block{};
  /// @param dropped number of moves that were left out, because the trace was full
  /// @param blocks of a run that is watched, with commas between them
  std::function<std::string(std::size_t dropped, const std::optional<WatchedBlocks>& blocks)>
      tail{};
};

/// Writes runs; the text is opaque here and in the store.
struct RunFormat {
  std::function<std::string(const RunReport&)> report;
  TraceFormat trace;
  /// Returns the seed of the setup in a stored order.
  std::function<std::uint64_t(const std::string& request)> seed;
  /// Reads a stored order, which names nothing outside except the control's disk.
  std::function<Result<RunOrder>(const std::string& request, const ControlTables&)> order{};
  /// The payload of the event run.finished.
  std::function<std::string(const RunReport&)> event;
};

/// A run as the store has it; its result is the report.
struct StoredRun : store::Run {
  std::string_view origin{};  ///< of the data folder

  std::string id_text() const { return run_id_text(id, origin); }
};

/// Writes the trace of a run, packed at once: the text of a long trace has 50 MB, packed a
/// twentieth of it.
class TraceWriter {
 public:
  /// @param format outlives the writer.
  TraceWriter(const TraceFormat& format, std::vector<machine::Axis> axes);

  void add(const machine::TracedMove& move, const TracePlace& place);
  /// A block of a run that is watched.
  void add(const TracePlace& place, std::span<const interpreter::ParameterValue> values,
           std::span<const klartext::DiagnosticNote> origins);
  /// Returns the whole trace, for TraceReader. Then nothing can be added.
  std::string finish(std::size_t dropped);

 private:
  const TraceFormat& format_;
  const std::vector<machine::Axis> axes_;
  GzipWriter packed_;
  std::string text_;  ///< of the last move
  std::optional<WatchedBlocks> blocks_;
  std::size_t moves_ = 0;  ///< added so far
};

/// The trace of a run without a move.
std::string empty_trace(const TraceFormat& format);

/// Reads a stored trace piece by piece. Those that were stored before traces were packed are text.
class TraceReader {
 public:
  explicit TraceReader(std::string stored);

  /// Returns the stored bytes, for readers of gzip; none if they are text.
  /// @pre next() was not called; nothing else is called afterwards.
  std::optional<std::string> take_packed();

  /// The next piece of the text; empty at its end. @errors StorageCorrupt.
  Result<std::string> next();

 private:
  bool is_packed_;
  std::string stored_;                  ///< until it is read
  std::unique_ptr<GzipReader> reader_;  ///< of a packed trace
};

}  // namespace fitgauge::app

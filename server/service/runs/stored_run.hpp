#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "base/gzip.hpp"
#include "service/runs/run_report.hpp"

namespace fitgauge::store {
struct Run;
enum class RunStatus : std::uint8_t;
}  // namespace fitgauge::store

namespace fitgauge::app {

/// A run as the store has it.
struct StoredRun {
  std::int64_t id = 0;
  std::string_view origin;  ///< of the data folder
  RunState state = RunState::Queued;
  std::string program;
  std::string request;
  std::string report;  ///< empty until it is over
  Timestamp created_at;
  std::optional<Timestamp> finished_at;

  std::string id_text() const { return run_id_text(id, origin); }
};

store::RunStatus run_status(RunState state);
RunState run_state(store::RunStatus status);
/// @param origin of the data folder
StoredRun stored_run(store::Run run, std::string_view origin);

/// Writes the trace of a run, packed as it comes: the text of a long one is 50 MB, packed a
/// twentieth of it, and a run holds no more than that.
class TraceWriter {
 public:
  /// @param format outlives the writer.
  TraceWriter(const TraceFormat& format, std::vector<machine::Axis> axes);

  void add(const machine::TracedMove& move, const TracePlace& place);
  /// A block of a run that is watched.
  void add(const TracePlace& place, std::span<const interpreter::ParameterValue> values);
  /// The whole trace, for TraceReader. Nothing can be added any more.
  std::string finish(std::size_t dropped);

 private:
  const TraceFormat& format_;
  const std::vector<machine::Axis> axes_;
  GzipWriter packed_;
  std::string text_;  ///< of the last move
  std::optional<WatchedBlocks> blocks_;
  bool is_empty_ = true;
};

/// The trace of a run without a move.
std::string empty_trace(const TraceFormat& format);

/// Reads a stored trace piece by piece. Those that were stored before traces were packed are text.
class TraceReader {
 public:
  explicit TraceReader(std::string stored);

  /// The bytes as they are stored, for who reads gzip; none where they are text.
  /// @pre next() was not called; nothing else is called any more.
  std::optional<std::string> take_packed();

  /// The next piece of the text; empty at its end. @errors StorageCorrupt.
  Result<std::string> next();

 private:
  bool is_packed_;
  std::string stored_;                  ///< until it is read
  std::unique_ptr<GzipReader> reader_;  ///< of one that is packed
};

}  // namespace fitgauge::app

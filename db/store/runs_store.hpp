#pragma once

#include "base/clock.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store {

// Their codes are stored (code_of): never change the order.
enum class RunStatus : std::uint8_t {
  Queued,
  Running,
  Completed,
  Stopped,
  Failed,
  LimitExceeded,
  Cancelled,
  Cancelling,  ///< still running; another daemon of the database requested its end
};
inline constexpr std::array<std::string_view, 8> kRunWords = {
    "queued", "running",        "completed", "stopped",
    "failed", "limit_exceeded", "cancelled", "running"};
constexpr std::string_view word(RunStatus status) {
  return kRunWords.at(static_cast<std::size_t>(status));
}
constexpr RunStatus last_of(RunStatus) { return RunStatus::Cancelling; }

constexpr bool is_finished(RunStatus status) {
  return status >= RunStatus::Completed && status <= RunStatus::Cancelled;
}

struct Run {
  std::int64_t id = 0;
  RunStatus status = RunStatus::Queued;
  std::string program{};
  std::string request{};  ///< opaque here
  std::string result{};   ///< opaque here; empty until finished
  Timestamp created_at{};
  std::optional<Timestamp> finished_at{};
  std::optional<std::string> caller{};
};

/// A file a run has written.
struct RunFile {
  std::string path{};  ///< on the control's disk
  std::string content{};
};

struct RunOutcome {
  RunStatus status = RunStatus::Completed;
  std::string_view result{};
  std::string_view trace{};
  std::span<const RunFile> files{};
};

struct RunFilter {
  std::optional<RunStatus> status{};
  std::optional<std::string> program{};  ///< the whole path, without regard to ASCII case
};

/// Runs with their files and traces.
class RunsStore : public OnConnection<RunsStore> {
 public:
  /// Stores a run that is queued, running or, with `finish` in the same job, already over.
  /// `run.id` is ignored. @returns the id, rising.
  std::int64_t create(const Run& run);

  /// @errors RunUnknown; RunFinished when it is over.
  Result<void> start(std::int64_t id);
  Result<void> finish(std::int64_t id, const RunOutcome& outcome, std::int64_t now_ns);

  /// Requests the daemon of the run to end it; if that daemon dies, its successor ends the run.
  /// @errors RunUnknown; RunFinished if it is over.
  Result<void> ask_to_cancel(std::int64_t id);
  /// Returns the runs that must end and have not. For a database that daemons share.
  std::vector<std::int64_t> to_be_cancelled() const;

  std::optional<RunStatus> status(std::int64_t id) const;
  std::optional<Run> find(std::int64_t id) const;
  std::optional<std::string> trace(std::int64_t id) const;
  /// The file of a run by its name (the last part of its path), without regard to ASCII case.
  /// @param path the whole path; empty: the first of that name by path
  std::optional<RunFile> file(std::int64_t id, std::string_view name,
                              std::string_view path = {}) const;

  struct Page {
    std::vector<Run> runs;
    std::optional<std::int64_t> next;  ///< cursor of the next page
  };
  /// Returns the runs before the cursor, newest first.
  Page list(const RunFilter& filter, std::optional<std::int64_t> after, std::size_t limit) const;

  /// Returns up to `limit` unfinished runs whose daemon has ended: all unfinished runs if only one
  /// daemon uses the database.
  std::vector<Run> abandoned(std::size_t limit) const;

  /// Queues an abandoned run again for this daemon. @returns whether it was still abandoned.
  bool take_over(std::int64_t id);

  /// Deletes up to `limit` runs that finished before `before_ns`, with files and traces.
  /// @returns how many.
  std::int64_t purge(std::int64_t before_ns, std::int64_t limit);
};

}  // namespace fitgauge::store

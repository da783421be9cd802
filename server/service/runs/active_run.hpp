#pragma once

#include "base/thread.hpp"
#include "nc/machine/axis.hpp"
#include "nc/run/run_log.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::app {

/// The display of a control while a program runs, at one moment between two blocks.
struct LiveState {
  std::string program{};    ///< the running program, called or main
  std::uint32_t block = 0;  ///< its number, as written or counted
  /// Position of the tool tip in the active coordinate system, mm and degrees; only the machine's
  /// axes.
  std::vector<std::pair<machine::Axis, double>> axes{};
  int tool = 0;
  machine::Axis tool_axis = machine::Axis::Z;
  double tool_length = 0;  ///< mm
  double tool_radius = 0;
  std::vector<interpreter::RunMessage> errors{};
  /// Written until now; null as long as nobody has asked for them.
  std::shared_ptr<const std::vector<interpreter::WrittenFile>> files{};
};

/// The request of a reader of a run.
enum class Look : std::uint8_t { Nothing, State, StateAndFiles };

/// End of a run, which callers await.
struct FinishedRun {
  RunState state = RunState::Failed;
  std::string report;  ///< as it is stored
};

/// A queued or running run: its output until now, its followers, and its cancellation. Thread-safe.
/// Callbacks run on the run's thread without a lock; an exception of one is reported and stops
/// neither the run nor other callbacks.
class ActiveRun {
 public:
  ActiveRun(std::int64_t id, std::string_view origin, std::shared_ptr<const RunOrder> order,
            Timestamp created_at)
      : id_(id), origin_(origin), order_(std::move(order)), created_at_(created_at) {}
  ActiveRun& operator=(ActiveRun&&) = delete;  // neither copied nor moved

  std::int64_t id() const { return id_; }
  std::string id_text() const { return run_id_text(id_, origin_); }
  const RunOrder& order() const { return *order_; }
  const std::string& program() const { return order_->program.text(); }
  Timestamp created_at() const { return created_at_; }
  RunState state() const;
  /// Returns whether its end is being stored: the store then knows more than this.
  bool is_being_stored() const { return being_stored_; }

  /// Seen within a few thousand blocks; a run that is over does not mind.
  void cancel() { stop_.request_stop(); }
  std::stop_token stop_token() const { return stop_.get_token(); }

  // For followers of the run.

  /// News since the last read of a follower.
  struct News {
    std::uint64_t version = 0;  ///< rises with every change
    RunState state = RunState::Queued;
    std::uint64_t blocks = 0;
    std::vector<std::string> lines;  ///< printed after the first `seen_lines`
    /// Set once the run is over; an Error when it could not be stored.
    std::optional<Result<FinishedRun>> end;
  };
  News news(std::size_t seen_lines) const;

  using Ticket = std::uint64_t;
  /// Calls `wake` once, as soon as the version differs from `seen`; at once if it does already.
  Ticket await(std::uint64_t seen, std::function<void()> wake);
  /// Removes `wake`.
  void forget(Ticket ticket);

  /// Calls `done` once when the run is over; at once if it is.
  void on_end(std::function<void(const Result<FinishedRun>&)> done);

  /// Returns the state of the machine as reported within `patience`, or the last reported one.
  /// Files that are not requested are also the last reported ones. A finished run has reported its
  /// last state. Blocks.
  LiveState look(Look what, std::chrono::milliseconds patience);

  // For the thread that runs or ends it.

  /// The condition of a waiting reader.
  Look wanted() const { return wanted_.load(std::memory_order_relaxed); }
  void show(LiveState state);

  void started();
  void progressed(std::uint64_t blocks);
  void printed(std::string_view line);
  /// Marks that the end is about to be stored.
  void being_stored() { being_stored_ = true; }
  void finished(Result<FinishedRun> end);

 private:
  template <class Change>
  void change(const Change& change);

  const std::int64_t id_;
  const std::string_view origin_;
  const std::shared_ptr<const RunOrder> order_;
  const Timestamp created_at_;
  std::stop_source stop_;
  std::atomic<bool> being_stored_{false};

  mutable std::mutex mutex_;
  std::uint64_t version_ = 1;
  RunState state_ = RunState::Queued;
  std::uint64_t blocks_ = 0;
  std::vector<std::string> lines_;
  std::optional<Result<FinishedRun>> end_;
  Ticket next_ticket_ = 1;
  std::map<Ticket, std::function<void()>> waiting_;
  std::vector<std::function<void(const Result<FinishedRun>&)>> at_end_;

  std::atomic<Look> wanted_{Look::Nothing};
  std::condition_variable shown_;
  std::uint64_t shows_ = 0;           ///< counts the states shown
  std::uint64_t shows_of_files_ = 0;  ///< shows of the state with files
  LiveState live_;
};

/// Messages about runs between daemons with a shared database: cancellations, and states of runs
/// that are followed at another daemon. Polls four times a second, only while there is such a run.
/// Thread-safe.
class SharedRuns {
 public:
  /// Runs of this daemon.
  struct Own {
    std::function<bool()> has_any;
    std::function<void(std::int64_t id)> cancel;  ///< cancels a run of this daemon
  };

  SharedRuns(Database& database, Own own);
  SharedRuns& operator=(SharedRuns&&) = delete;  // neither copied nor moved
  ~SharedRuns();

  /// Ends all following with ShuttingDown, also later requests. Blocks.
  void stop();

  /// A run of another daemon for its followers here: its state, and after its end all its output.
  /// It ends with an Error if the database cannot be read.
  std::shared_ptr<ActiveRun> follow(const StoredRun& run);

 private:
  using Followed = std::map<std::int64_t, std::weak_ptr<ActiveRun>>;

  void run(const std::stop_token& stop);
  void look(const Followed& followed, bool runs_any);
  Followed followed();
  void end(const Followed& followed, const Error& error);

  Database& database_;
  const Own own_;
  std::mutex mutex_;
  Followed followed_;
  bool stopped_ = false;
  Thread thread_;  // ends before the members it uses
};

/// Services of a run; shared by all runs.
struct RunSurroundings {
  const interpreter::ControlDisk& disk;
  interpreter::ProgramCache& programs;
  const Clock& clock;
  const TraceFormat& trace;
  bool shows_last = false;  ///< whether the run's last state is shown, with its files
};

struct ExecutedRun {
  interpreter::RunResult result;
  std::string trace;  ///< packed: TraceReader reads it
};

/// Builds the machine of the run's setup and runs its program on the calling thread; reports the
/// progress to `active`. Errors of the program are in the result.
/// @throws if the storage fails, or for a bug.
ExecutedRun execute(const RunSurroundings& surroundings, ActiveRun& active);

/// Result of a run that did not reach its first block.
interpreter::RunResult unstarted(interpreter::RunStatus status, interpreter::MessageKind kind,
                                 std::string text, std::string program);

/// Returns the measurements of a run (decision 27): one for each value that a cycle judged by
/// limits of its block, so the verdict of the cycle is among them. A cycle without a judged value
/// gives its first value without a verdict; cycles 0 and 1 give none. The texts are views of the
/// report and the order.
std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller);

}  // namespace fitgauge::app

#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/thread.hpp"
#include "base/worker_pool.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "record/origins.hpp"
#include "service/files/file_service.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/runs/active_run.hpp"
#include "service/runs/control_files.hpp"
#include "service/runs/control_tables.hpp"
#include "service/runs/run_executor.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::app {

struct RunServiceOptions {
  unsigned workers = 2;       ///< runs at the same time
  std::size_t queue = 64;     ///< runs that wait for a worker
  bool shares = false;        ///< other daemons have runs in the same database
  bool keeps_newest = false;  ///< for a control that shows what its machine does
};

struct RunQuery {
  std::optional<RunState> state;
  std::optional<std::string> program;  ///< the whole path, without regard to case
};

/// Checks programs, runs them on workers of its own and keeps what they leave. Thread-safe.
/// Functions with `done` do not block: it comes exactly once, on a storage thread or, when refused
/// at once, on the caller's.
class RunService {
 public:
  template <class T>
  using Done = std::function<void(Result<T>)>;

  /// @param origins outlive the service, as the pool does.
  /// @param orders the pool on which the functions below that block are called
  RunService(store::Database& database, const TableCatalog& tables, const Clock& clock,
             const Origins& origins, JobPool& orders, RunServiceOptions options);
  RunService& operator=(RunService&&) = delete;  // neither copied nor moved
  ~RunService();

  /// Marks as failed what an earlier process left queued or running, and from then on takes orders.
  /// Where daemons share the database, the runs of one that ended are run again by another: the
  /// seed of each makes it the same.
  /// @errors StorageUnavailable.
  Result<void> open(RunFormat format);

  /// Cancels every run and stores what they left. Blocks. @pre the orders are called off.
  void stop();

  // These block.

  using Diagnostics = std::vector<klartext::Diagnostic>;
  /// Everything there is to say about a file, by its kind: program, mask or table.
  /// @param draft its text as it is being written; without it the stored file.
  /// @errors ProgramUnknown, StorageUnavailable.
  Result<Diagnostics> check(const interpreter::ControlPath& path,
                            std::optional<std::string> draft = std::nullopt);
  /// The same of a file that is to be run, whatever it is called.
  Result<Diagnostics> check_program(const interpreter::ControlPath& path);

  /// Whether the program has the block in which the order starts. @errors RequestInvalid.
  Result<void> check_start(const RunOrder& order);

  /// A program, tidied and renumbered. @errors ProgramUnknown, ProgramInvalid, StorageUnavailable.
  Result<std::string> format(const interpreter::ControlPath& path);

  /// The tool, probe and preset tables of the control's disk.
  /// @errors TableFileMalformed, StorageUnavailable.
  Result<std::shared_ptr<const ControlTables>> control_tables();

  /// Reads the files that features of the setup name. @param pointer of the setup in its request
  /// @errors RequestInvalid with a detail for each file that cannot be used, StorageUnavailable.
  Result<void> load_meshes(machine::Setup& setup, std::string_view pointer, MissingFiles missing);

  /// The answer that was kept for a request, if any. @errors IdempotencyKeyReused,
  /// StorageUnavailable.
  Result<std::optional<Answer>> kept_answer(const IdempotencyScope& scope);

  /// Stores the order as a queued run and queues it.
  /// @param scope keeps the answer `accepted` makes of the run's id, in the same transaction.
  /// @errors Overloaded, ShuttingDown, StorageBusy, StorageUnavailable, IdempotencyInProgress.
  using Accepted = std::function<Answer(const ActiveRun&)>;
  Result<std::shared_ptr<ActiveRun>> start(RunOrder order,
                                           const std::optional<IdempotencyScope>& scope,
                                           const Accepted& accepted);

  // From any thread.

  /// @errors RunUnknown.
  /// Where a list goes on behind this run.
  std::string cursor(std::int64_t id) const { return run_id_text(id, origin_of(id)); }
  Result<std::int64_t> parse_id(std::string_view text) const {
    return parse_own_run_id(text, origins_);
  }

  /// The run while it is queued or under way; null from when its end is being stored, as the store
  /// then knows more.
  std::shared_ptr<ActiveRun> active(std::int64_t id) const;

  /// Queued runs, as `queued run r7`, whose order names something.
  std::vector<std::string> queued(const std::function<bool(const RunOrder&)>& names_it) const;

  /// The run that began last, under way or over; null before the first. It is kept only where
  /// RunServiceOptions::keeps_newest says so.
  std::shared_ptr<ActiveRun> newest() const;

  /// Runs by state, for metrics: those queued and running now, the others ended since the start.
  using Counts = std::array<std::uint64_t, kRunStates>;
  Counts counts() const;

  /// Ends a run that is queued or under way soon; a queued one without waiting for a worker.
  void cancel(const std::shared_ptr<ActiveRun>& active);
  /// The same of a run by its id, also of one that another daemon of the database runs. `done`
  /// comes when it is cancelled. @errors RunUnknown; RunFinished where it came to another end.
  void cancel(std::int64_t id, Done<void> done);

  /// A run for those who wait for its end.
  struct Followed {
    std::shared_ptr<ActiveRun> active;  ///< here or at another daemon; null for one that is over
    StoredRun stored;                   ///< where it is over
  };
  /// @errors RunUnknown, StorageUnavailable.
  void follow(std::int64_t id, Done<Followed> done);

  /// @errors RunUnknown, StorageUnavailable.
  void find(std::int64_t id, Done<StoredRun> done);
  /// @errors RunUnknown; RunUnfinished while there is none yet.
  void trace(std::int64_t id, Done<TraceReader> done);
  struct File {
    std::string path;
    std::string bytes;
  };
  /// By its file name, the first by path, or by its path. @errors RunUnknown, FileUnknown.
  void file(std::int64_t id, std::string name, Done<File> done);

  struct Page {
    std::vector<StoredRun> runs;  ///< the newest first, without request and report
    std::optional<std::int64_t> next;
  };
  void list(RunQuery query, std::optional<std::int64_t> after, std::size_t limit, Done<Page> done);

 private:
  using Check = Result<Diagnostics> (*)(const interpreter::ControlPath&,
                                        const interpreter::ControlDisk&, interpreter::ProgramCache&,
                                        Allowance&);
  Result<Diagnostics> check_with(Check find_all, const interpreter::ControlPath& path,
                                 std::optional<std::string> draft = std::nullopt);
  /// Of any state, until it is forgotten.
  std::shared_ptr<ActiveRun> own(std::int64_t id) const;
  void run(const std::shared_ptr<ActiveRun>& run);
  bool withdraw(std::int64_t id);
  void end(ActiveRun& active, ExecutedRun executed);
  ExecutedRun execute_guarded(ActiveRun& active);
  ExecutedRun without_moves(interpreter::RunResult result) const;
  Result<FinishedRun> keep(const RunReport& report, std::string_view trace,
                           const std::optional<std::string>& caller);
  /// The same of a run that another process left without an end.
  Result<FinishedRun> keep_failed(const store::Run& run, std::string why);
  Result<void> close_interrupted();
  void look_for_abandoned(const std::stop_token& stop);
  std::string_view origin_of(std::int64_t id) const { return origins_.own(Counted::Run, id); }
  Result<void> take_over(const store::Run& run);
  Result<std::shared_ptr<ActiveRun>> queue(std::shared_ptr<ActiveRun> active);

  store::Database& database_;
  const Clock& clock_;
  const Origins& origins_;
  const RunServiceOptions options_;
  LiveTables live_tables_;
  StoredDisk stored_;
  std::mutex tables_mutex_;
  ControlTablesCache control_tables_;
  std::mutex meshes_mutex_;
  MeshFiles meshes_;
  interpreter::ProgramCache programs_;
  RunFormat format_;
  JobPool& orders_;
  std::mutex starting_;  ///< held while a run is added, so that its place stays free
  mutable std::mutex mutex_;
  struct Entry {
    std::shared_ptr<ActiveRun> run;
    WorkerPool::Ticket ticket;
  };
  std::map<std::int64_t, Entry> active_;  ///< queued or under way: the one count of runs
  Counts ended_{};
  std::shared_ptr<ActiveRun> newest_;
  // The workers end before what they use.
  WorkerPool running_;
  Thread looking_;                      ///< for abandoned runs
  std::unique_ptr<SharedRuns> shared_;  ///< where daemons share the database
};

}  // namespace fitgauge::app

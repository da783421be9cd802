#pragma once

#include "base/worker_pool.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "record/measurement.hpp"
#include "service/files/file_service.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/runs/active_run.hpp"
#include "service/runs/control_files.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::app {

struct RunServiceOptions {
  unsigned workers = 2;       ///< runs at the same time
  std::size_t queue = 64;     ///< runs that wait for a worker
  bool shares = false;        ///< other daemons have runs in the same database
  bool keeps_newest = false;  ///< for a control that shows what its machine does
};

/// Checks programs, runs them on its workers and stores the results. Thread-safe. Functions with
/// `done` do not block: it is called exactly once, on a storage thread or, if refused at once, on
/// the caller's.
class RunService : Records {
 public:
  /// @param orders pool for calls of the functions that block; outlives the service
  RunService(const Records& records, JobPool& orders, RunServiceOptions options);
  RunService& operator=(RunService&&) = delete;  // neither copied nor moved
  ~RunService();

  /// Marks unfinished runs of an earlier process as failed, then accepts orders. If daemons share
  /// the database, another daemon repeats the runs of a daemon that ended: each run's seed gives
  /// the same run.
  /// @errors StorageUnavailable.
  Result<void> open(RunFormat format);

  /// Cancels every run and stores the results. Blocks. @pre the orders are called off.
  void stop();

  // These block.

  using Diagnostics = std::vector<klartext::Diagnostic>;
  /// Returns all findings in a file, by its kind: program, mask or table.
  /// @param draft its text in an editor; without it the stored file.
  /// @errors ProgramUnknown, StorageUnavailable.
  Result<Diagnostics> check(const interpreter::ControlPath& path,
                            std::optional<std::string> draft = std::nullopt);
  /// Returns the findings in a file as a program, whatever its name.
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

  /// Returns the stored response to a request, if any. @errors IdempotencyKeyReused,
  /// StorageUnavailable.
  Result<std::optional<Answer>> kept_answer(const IdempotencyScope& scope);

  /// Stores the order as a queued run and queues it.
  /// @param scope stores the answer that `accepted` makes from the run's id, in the same
  ///   transaction.
  /// @errors Overloaded, ShuttingDown, StorageBusy, StorageUnavailable, IdempotencyInProgress.
  using Accepted = std::function<Answer(const ActiveRun&)>;
  Result<std::shared_ptr<ActiveRun>> start(RunOrder order,
                                           const std::optional<IdempotencyScope>& scope,
                                           const Accepted& accepted);

  // From any thread.

  /// @errors RunUnknown.
  /// Position of a list after this run.
  std::string cursor(std::int64_t id) const { return run_id_text(id, origin_of(id)); }
  Result<std::int64_t> parse_id(std::string_view text) const {
    return parse_own_run_id(text, origins_);
  }

  /// Returns a queued or running run. Null as soon as the end of the run is being stored: read the
  /// run from the store then.
  std::shared_ptr<ActiveRun> active(std::int64_t id) const;

  /// Queued runs, as `queued run r7`, whose order names something.
  std::vector<std::string> queued(const std::function<bool(const RunOrder&)>& names_it) const;

  /// The run that began last, running or finished; null before the first. Only available with
  /// RunServiceOptions::keeps_newest.
  std::shared_ptr<ActiveRun> newest() const;

  /// Runs by state, for metrics: those queued and running now, the others ended since the start.
  using Counts = std::array<std::uint64_t, kRunStates>;
  Counts counts() const;

  /// Ends a run that is queued or under way soon; a queued one without waiting for a worker.
  void cancel(const std::shared_ptr<ActiveRun>& active);
  /// Cancels a run by its id, also of another daemon of the database. `done` is called when it is
  /// cancelled. @errors RunUnknown; RunFinished if it ended otherwise.
  void cancel(std::int64_t id, Done<void> done);

  /// A run whose end callers await.
  struct Followed {
    std::shared_ptr<ActiveRun> active;  ///< here or at another daemon; null after its end
    StoredRun stored;                   ///< if it is over
  };
  /// @errors RunUnknown, StorageUnavailable.
  void follow(std::int64_t id, Done<Followed> done);

  /// @errors RunUnknown, StorageUnavailable.
  void find(std::int64_t id, Done<StoredRun> done);
  /// @errors RunUnknown; RunUnfinished while there is none yet.
  void trace(std::int64_t id, Done<TraceReader> done);
  /// Reads a file by its path, or by its name (the first by path). @errors RunUnknown, FileUnknown.
  void file(std::int64_t id, std::string name, Done<store::RunFile> done);

  struct Page {
    std::vector<StoredRun> runs;  ///< the newest first, without request and report
    std::optional<std::int64_t> next;
  };
  void list(store::RunFilter filter, std::optional<std::int64_t> after, std::size_t limit,
            Done<Page> done);

 private:
  using Check = Result<Diagnostics> (*)(const interpreter::ControlPath&,
                                        const interpreter::ControlDisk&, interpreter::ProgramCache&,
                                        Allowance&);
  Result<Diagnostics> check_with(Check find_all, const interpreter::ControlPath& path,
                                 std::optional<std::string> draft = std::nullopt);
  /// Returns a run in any state, until it is forgotten.
  std::shared_ptr<ActiveRun> own(std::int64_t id) const;
  void run(const std::shared_ptr<ActiveRun>& run);
  bool withdraw(std::int64_t id);
  void end(ActiveRun& active, ExecutedRun executed);
  /// The end of a run on its way to the store.
  struct End {
    RunReport report;
    std::string trace;
    std::optional<std::string> caller;
  };
  /// Stores the end, or, while the storage takes nothing, leaves it to store_waiting().
  Result<FinishedRun> keep_or_wait(End end);
  void store_waiting(const std::stop_token& stop);
  ExecutedRun execute_guarded(ActiveRun& active);
  ExecutedRun without_moves(interpreter::RunResult result) const;
  Result<FinishedRun> keep(const RunReport& report, std::string_view trace,
                           const std::optional<std::string>& caller);
  /// Stores a run that another process left without an end.
  Result<FinishedRun> keep_failed(const store::Run& run, std::string why);
  Result<void> close_interrupted();
  void look_for_abandoned(const std::stop_token& stop);
  std::string_view origin_of(std::int64_t id) const { return origins_.own(Counted::Run, id); }
  Result<void> take_over(const store::Run& run);
  Result<std::shared_ptr<ActiveRun>> queue(std::shared_ptr<ActiveRun> active);

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
  std::mutex starting_;  ///< held while a run is added, to reserve its place
  mutable std::mutex mutex_;
  struct Entry {
    std::shared_ptr<ActiveRun> run;
    WorkerPool::Ticket ticket;
  };
  std::map<std::int64_t, Entry> active_;  ///< queued or running: all runs are counted here
  Counts ended_{};
  std::vector<End> waiting_ends_;  ///< of runs that are over and still in active_
  std::condition_variable_any end_waits_;
  std::shared_ptr<ActiveRun> newest_;
  // The workers must end before the members that they use.
  WorkerPool running_;
  Thread storing_;                      ///< of the ends that wait
  Thread looking_;                      ///< for abandoned runs
  std::unique_ptr<SharedRuns> shared_;  ///< if daemons share the database
};

}  // namespace fitgauge::app

#pragma once

#include "base/clock.hpp"
#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "db/store/jobs.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

/// Findings about the database, the most serious first: the health is of the first.
enum class Finding : std::uint8_t {
  SetBack,  ///< an older copy was restored; for good
  Damage,   ///< for good; the first reason stays
  Writes,   ///< the last commit failed
  Away,     ///< PostgreSQL does not answer
  Check     ///< it is being checked
};

/// Collects findings of the writer, the readers and the checks, and reports each change of state
/// once. Thread-safe.
class HealthMonitor {
 public:
  using Report = std::function<void(const Health&)>;

  /// @param report called in the order of the changes, on the thread that found out.
  explicit HealthMonitor(Report report = {}) : report_(std::move(report)) {}

  /// Notes a finding. @param reason empty: it does not apply any more
  void note(Finding finding, std::string reason = {});

  Health health() const;

 private:
  Health current() const;

  const Report report_;
  mutable std::mutex mutex_;
  std::array<std::string, 5> reasons_;  ///< by Finding
};

}  // namespace fitgauge::store

namespace fitgauge::store::sql {

/// A connection with its stores, and the limits of its transactions. Used by one thread. After a
/// StorageFailure it is closed and another is opened, unless it stays reliable.
class Session {
 public:
  Session& operator=(Session&&) = delete;  // neither copied nor moved
  virtual ~Session() = default;

  virtual Stores& stores() = 0;

  /// Begins a transaction in which all statements see the state of the first one.
  virtual void begin_reading() = 0;
  /// Locks out other writers until the commit: reads stay valid, and ids follow the order of
  /// commits.
  virtual void begin_writing() = 0;
  virtual void commit() = 0;
  /// Whether it can be used again, rolled back, after the call that failed just now.
  virtual bool is_reliable() const { return false; }
  /// Rolls back; allowed after a commit() that failed.
  virtual void rollback() noexcept = 0;

  /// Encloses each of several jobs of a transaction: undo() reverts its changes.
  virtual void savepoint() = 0;
  virtual void undo() = 0;
  /// Fails if a postponed statement of the job failed.
  virtual void settle() = 0;
  virtual void release() = 0;

  /// Writes something, to find out whether commits work again after one has failed.
  virtual void probe() = 0;
  /// Tidies up between two transactions. Only the writer calls it.
  virtual void tidy_up(WriterCounters& counters) = 0;
};

using OpenSession = std::function<std::unique_ptr<Session>()>;

}  // namespace fitgauge::store::sql

namespace fitgauge::store {

/// The reader threads with their connections. The destructor runs queued jobs.
class ReaderThreads final : public ReadPool {
 public:
  ReaderThreads(const OpenOptions& options, HealthMonitor& health, sql::OpenSession open);
  ReaderThreads& operator=(ReaderThreads&&) = delete;  // neither copied nor moved
  ~ReaderThreads();

  /// Runs queued jobs and ends the threads; later jobs are refused.
  void stop();

 private:
  void run();
  void read(std::unique_ptr<sql::Session>& session, Job<const Stores>& job);

  const OpenOptions options_;
  HealthMonitor& health_;
  const sql::OpenSession open_;
  std::vector<Thread> threads_;
};

struct Stores;

/// Time by which runs and idempotency keys expire, and a count of the deletions. A clock may be
/// wrong (a dead battery, the first response of NTP) and a deletion is final: the time is never
/// later than the newest record's `received_at`, and it advances only after the clock was steady
/// for a day of running time. The day may have several starts, and the time advances then to the
/// begin of the day. Used by one thread.
class Retention {
 public:
  /// @returns none while nothing may expire: until the clock was steady for the first time.
  /// @throws StorageFailure
  std::optional<Timestamp> time(const SteadyTime& clock, const Stores& stores);
  /// Stores the state for the next start, from time to time. @throws StorageFailure
  void keep(Stores& stores);

  void deleted(std::int64_t keys, std::int64_t runs);
  /// @param now of a clock that nobody sets. @param more whether the next step may delete more.
  /// @returns a sentence on the deletions: the first at once, those that follow once an hour.
  std::optional<std::string> report(std::chrono::nanoseconds now, bool more);

 private:
  struct State {
    std::int64_t time_ns = 0;  ///< 0: none yet
    std::int64_t next_ns = 0;  ///< the time after a steady day
    std::int64_t held_ns = 0;  ///< running time of that day
    std::int64_t seen_ns = 0;  ///< the clock
  };

  bool has_begun_ = false;
  State state_;
  State kept_;
  std::chrono::nanoseconds held_{0};  ///< of the clock at the last check
  std::int64_t keys_ = 0;
  std::int64_t runs_ = 0;
  std::optional<std::chrono::nanoseconds> reported_;
};

/// Does one step of maintenance: deletes some expired responses, old runs and events, indexes the
/// next blocks of measurements. One transaction of some milliseconds.
/// @returns whether there is more to do.
bool run_maintenance_step(sql::Session& session, const OpenOptions& options,
                          const SteadyTime& clock, Retention& retention);

/// Schedules the writer's maintenance steps: at once if it is idle, and under any load after kShare
/// times the duration of the last step. Used by the writer's thread.
class MaintenancePace {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// Records a step from `begin` to `end`. @param more whether work remains.
  void stepped(Time begin, Time end, bool more);
  /// Jobs were committed: there may be something to do before the next daily round.
  void committed(Time now);

  /// Returns the time to wait for jobs before the next step.
  std::chrono::milliseconds patience(Time now) const;
  /// Whether a step is due although jobs keep coming.
  bool is_due(Time now) const { return now >= when_busy_; }

 private:
  bool has_more_ = false;
  Time when_quiet_{};
  Time when_busy_{};
};

/// The writer's thread with its session. The destructor runs queued jobs and closes.
class WriterThread final : public Writer {
 public:
  /// Opens a session, so that a start fails if the database cannot be opened.
  /// @param check throws a StorageFailure if the session writes to a replaced database; called
  /// before each transaction, again in it if more jobs join it, and once a second.
  WriterThread(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
               sql::OpenSession open, std::function<void()> check = {});
  WriterThread& operator=(WriterThread&&) = delete;  // neither copied nor moved
  ~WriterThread();

  /// Runs queued jobs and closes; later jobs are refused.
  void stop();

 private:
  using WriteJob = Job<Stores>;
  using Jobs = Queue::Items;

  void run();
  void commit(Jobs& jobs);
  std::optional<Error> try_commit(Jobs& jobs, std::vector<std::optional<Error>>& errors);
  std::optional<Error> run_alone(WriteJob& job);
  void run_in_savepoints(Jobs& jobs, std::vector<std::optional<Error>>& errors);
  std::optional<Error> run_in_savepoint(WriteJob& job);
  void commit_transaction();
  Error bug_of(const std::exception& thrown);
  std::chrono::milliseconds patience() const;
  SteadyTime steady_time() const;
  void begin_retention();
  void look();
  void maintain();
  void probe();
  void succeed();
  void fail(const Error& error);
  sql::Session& session();

  const OpenOptions options_;
  const Clock& clock_;
  HealthMonitor& health_;
  const sql::OpenSession open_;
  const std::function<void()> check_;
  std::unique_ptr<sql::Session> session_;  // from here on used only by the thread
  bool failing_ = false;
  MaintenancePace pace_;
  Retention retention_;
  Thread thread_;
};

}  // namespace fitgauge::store

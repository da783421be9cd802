#pragma once

#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "db/store/jobs.hpp"
#include "db/store/open_options.hpp"
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

}  // namespace fitgauge::store

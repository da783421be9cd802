#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include "base/clock.hpp"
#include "base/thread.hpp"
#include "db/postgres/connection.hpp"
#include "db/sql/session.hpp"
#include "db/sql/statement.hpp"
#include "db/store/database.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {

/// Decides when commits of this daemon are notified. Each NOTIFY wakes every daemon and one of its
/// sessions on the server, so there is one for all commits within 20 ms: a transaction notifies if
/// the last one is that long ago, and is postponed otherwise. The next transaction then notifies
/// for both, or the listener if there is none in time. Postponed notifications of a killed daemon
/// are lost.
class Notifications {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kInterval{20};

  Notifications& operator=(Notifications&&) = delete;  // neither copied nor moved
  ~Notifications() { close(event_); }

  /// Returns whether the transaction notifies others. Only the writer calls it.
  bool is_due() {
    const auto now = Clock::now();
    const bool due = now >= next_;
    if (due) next_ = now + kInterval;
    return due;
  }
  /// Records a commit. Only the writer calls it.
  void committed(bool notified) {
    if (notified) {
      postponed_ = false;
    } else {
      postpone();
    }
  }

  /// Thread-safe; wakes the listener if nothing was postponed before.
  void postpone() {
    if (!postponed_.exchange(true)) wake_listener();
  }
  /// @returns whether something was postponed; then the caller must notify.
  bool take_postponed() { return postponed_.exchange(false); }

  void wake_listener() const { eventfd_write(event_, 1); }
  /// The descriptor that the listener polls: readable once it was woken.
  int wake_up() const { return event_; }

 private:
  const int event_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> postponed_{false};
  Clock::time_point next_{};
};

/// Class of the advisory locks that living daemons hold; 0001_service.sql has the number too.
inline constexpr int kDaemonLocks = 0x46744761;

/// Receives the notifications of all daemons and sends the postponed ones of this daemon, on its
/// own connection and thread. Holds the lock that shows that this daemon is alive. Opens a lost
/// connection again and then reports a notification, because some may be lost. Every few seconds it
/// reads the state of the server and reports a notification, because a killed daemon may not have
/// notified.
class Listener {
 public:
  using Figures = std::optional<ServerFigures>;  ///< absent while the server is unreachable

  /// @param notifications must outlive it.
  /// @param heard called on the thread after one or more commits, with whether one of them has
  /// changed names (store::postgres::Names); must not block.
  /// @param told called on the thread with changes of the server's state; must not block.
  Listener(std::string address, std::int64_t daemon, Notifications& notifications,
           std::function<void(bool names)> heard, std::function<void(Figures)> told);
  Listener& operator=(Listener&&) = delete;  // neither copied nor moved
  /// Sends the postponed notification.
  ~Listener();

  /// Ends as soon as the server is unreachable, instead of connecting again.
  void end_when_away() { ends_when_away_ = true; }

 private:
  void run(const std::stop_token& stop);
  void listen(const std::stop_token& stop);

  const std::string address_;
  const std::int64_t daemon_;
  Notifications& notifications_;
  const std::function<void(bool names)> heard_;
  const std::function<void(Figures)> told_;
  std::atomic<bool> ends_when_away_{false};
  Thread thread_;
};

/// Data of the database that the application keeps in memory and other daemons change (table
/// revisions, origins, log keys). It is informed before a transaction shows rows that need new
/// ones.
class Names {
 public:
  /// @param changed see OpenOptions::names_changed.
  explicit Names(std::function<bool(const Stores&)> changed) : changed_(std::move(changed)) {}

  /// @param is_new of the connection: the database may be an older one than before.
  void look(std::int64_t version, const Stores& stores, bool is_new) {
    if ((version <= seen_ && !is_new) || !changed_) return;
    const std::lock_guard lock(mutex_);
    if ((version > seen_ || is_new) && changed_(stores)) seen_ = version;
  }

 private:
  const std::function<bool(const Stores&)> changed_;
  std::mutex mutex_;
  std::atomic<std::int64_t> seen_{-1};
};

/// The position in the database that this daemon knows to be on the disk. An older copy that was
/// restored under the daemon is behind it: from then on until a restart each transaction fails,
/// because ids would be given out twice. Thread-safe.
class Position {
 public:
  /// @param set_back called once, with the reason.
  explicit Position(std::function<void(const std::string&)> set_back = {})
      : set_back_(std::move(set_back)) {}

  std::int64_t newest() const { return newest_; }
  void saw(std::int64_t last_id);
  /// Whether the database's first row has the version that this daemon found first; 0: no row. A
  /// restore writes it anew, also if the copy is as long as what this daemon knows.
  bool is_first_row(std::int64_t version);
  /// @throws StorageFailure, for good if this daemon has used the database before.
  [[noreturn]] void restored();
  /// @throws StorageFailure after set_back().
  void require() const;
  void set_back(const std::string& why);

 private:
  const std::function<void(const std::string&)> set_back_;
  std::atomic<std::int64_t> newest_{0};
  std::atomic<std::int64_t> first_row_{0};
  mutable std::mutex mutex_;
  std::string why_;
};

/// A connection with its stores. Writing transactions lock the row `head` from their first
/// statement to their commit, so that all daemons write in turn. The next transaction does not wait
/// for the disk: the WAL keeps their order, and commit() returns when everything that was read and
/// written is on the disk.
class Session final : public sql::Session {
 public:
  /// @param daemon what open runs are marked with. @param names, `position` and `notifications`
  /// outlive the session.
  Session(const OpenOptions& options, const Clock& clock, std::int64_t daemon, Names& names,
          Position& position, Notifications& notifications, GivesUp gives_up = gives_up_statement);

  Stores& stores() override { return stores_; }
  void begin_reading() override;
  void begin_writing() override;
  void commit() override { writes_ ? commit_written() : commit_read(); }
  void rollback() noexcept override;
  void savepoint() override;
  void undo() override;
  void settle() override;
  void release() override { release_.run(); }
  void probe() override;
  void tidy_up(WriterCounters& /*counters*/) override {}

 private:
  void read_head(sql::Statement& head);
  void commit_written();
  void commit_read();
  void settle_undone();
  void require_position(std::int64_t newest);

  Connection connection_;
  Stores stores_;
  Names& names_;
  Position& position_;
  Notifications& notifications_;
  const bool is_durable_;
  // Each is parsed and planned once, like the statements of the stores.
  sql::Statement begin_reading_{connection_, "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY"};
  sql::Statement begin_writing_{connection_, "BEGIN ISOLATION LEVEL READ COMMITTED READ WRITE"};
  /// A waiting transaction is woken twice, as the next one and as the owner, and then reads the row
  /// again. A transaction that waits for this lock finds the row free. The row still excludes
  /// transactions that do not use the lock.
  sql::Statement queue_for_head_{connection_, "SELECT pg_advisory_xact_lock(6044937214080451862)"};
  /// Positions in the WAL as numbers. A transaction sees data written before its first statement.
  static constexpr const char* kHead =
      "SELECT last_id, own_rows, names, (pg_current_wal_insert_lsn() - '0/0')::bigint,"
      " coalesce((SELECT xmin::text::bigint FROM schema_migrations ORDER BY number LIMIT 1), 0)"
      " FROM head";
  sql::Statement head_{connection_, kHead};
  sql::Statement locked_head_{connection_, std::string(kHead) + " FOR UPDATE"};
  /// The commit releases the row before the WAL is on the disk; the session waits for the disk
  /// afterwards. Not if a standby must have it, because reads would then wait for the standby; nor
  /// with new names, which daemons keep in memory beyond a crash of the server.
  sql::Statement set_head_{
      connection_,
      "UPDATE head SET last_id = ?, own_rows = ? RETURNING"
      " CASE WHEN names = ? AND current_setting('synchronous_standby_names') = ''"
      " THEN set_config('synchronous_commit', 'off', true) END,"
      " CASE WHEN ? = 1 THEN pg_notify('fitgauge', '') END"};
  sql::Statement commit_{connection_, "COMMIT"};
  /// There is one WAL: after a later commit is on the disk, all earlier ones are. PostgreSQL waits
  /// for the disk only if the transaction has written something, even an empty message. If a commit
  /// did not release the row early, the disk and the standby have it.
  sql::Statement flush_{connection_,
                        "SELECT pg_logical_emit_message(true, 'fitgauge', '')"
                        " WHERE pg_current_wal_flush_lsn() < pg_current_wal_insert_lsn()"};
  sql::Statement flush_here_{connection_,
                             "SELECT pg_logical_emit_message(true, 'fitgauge', ''), "
                             "set_config('synchronous_commit', 'local', true)"};
  sql::Statement flushed_{connection_, "SELECT (pg_current_wal_flush_lsn() - '0/0')::bigint"};
  sql::Statement savepoint_{connection_, "SAVEPOINT job"};
  sql::Statement release_{connection_, "RELEASE job"};
  bool is_new_ = true;
  bool writes_ = false;
  Head begun_;  ///< as the transaction found it
  Head before_job_;
  std::int64_t seen_wal_ = 0;  ///< the WAL's end when the transaction began to look
};

}  // namespace fitgauge::store::postgres

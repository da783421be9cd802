#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

#include "base/clock.hpp"
#include "db/postgres/connection.hpp"
#include "db/postgres/listener.hpp"
#include "db/sql/session.hpp"
#include "db/sql/statement.hpp"
#include "db/store/open_options.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {

/// Data of the database that the application keeps in memory and other daemons change (table
/// revisions, origins, log keys). It is informed before a transaction shows rows that need new
/// ones.
class Names {
 public:
  /// @param changed see OpenOptions::names_changed.
  explicit Names(std::function<bool(const Stores&)> changed) : changed_(std::move(changed)) {}

  void look(std::int64_t version, const Stores& stores) {
    if (version <= seen_ || !changed_) return;
    const std::lock_guard lock(mutex_);
    if (version > seen_ && changed_(stores)) seen_ = version;
  }

 private:
  const std::function<bool(const Stores&)> changed_;
  std::mutex mutex_;
  std::atomic<std::int64_t> seen_{-1};
};

/// A connection with its stores. Writing transactions lock the row `head` from their first
/// statement to their commit, so that all daemons write in turn. The next transaction does not wait
/// for the disk: the WAL keeps their order, and commit() returns when everything that was read and
/// written is on the disk.
class Session final : public sql::Session {
 public:
  /// @param daemon what open runs are marked with. @param names and `notifications` outlive the
  /// session.
  Session(const OpenOptions& options, const Clock& clock, std::int64_t daemon, Names& names,
          Notifications& notifications, GivesUp gives_up = gives_up_statement);

  Stores& stores() override { return stores_; }
  void begin_reading() override;
  void begin_writing() override;
  void commit() override;
  void rollback() noexcept override;
  void savepoint() override;
  void undo() override;
  void settle() override;
  void release() override;
  void probe() override;
  void tidy_up(WriterCounters& /*counters*/) override {}

 private:
  void read_head(sql::Statement& head);
  void commit_written();
  void commit_read();
  void settle_undone();

  Connection connection_;
  Stores stores_;
  Names& names_;
  Notifications& notifications_;
  const bool is_durable_;
  // Each is parsed and planned once, like the statements of the stores.
  sql::Statement begin_reading_;
  sql::Statement begin_writing_;
  sql::Statement queue_for_head_;
  sql::Statement head_;
  sql::Statement locked_head_;
  sql::Statement set_head_;
  sql::Statement commit_;
  sql::Statement flush_;
  sql::Statement flush_here_;
  sql::Statement flushed_;
  sql::Statement savepoint_;
  sql::Statement release_;
  bool writes_ = false;
  Head begun_;  ///< as the transaction found it
  Head before_job_;
  std::int64_t seen_wal_ = 0;  ///< the WAL's end when the transaction began to look
};

}  // namespace fitgauge::store::postgres

#include "db/store/database.hpp"

#include "db/postgres/connection.hpp"
#include "db/postgres/session.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sql/session.hpp"
#include "db/sql/statement.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {
namespace {

bool has_schema(Connection& connection) {
  sql::Statement find(connection, "SELECT count(*) FROM pg_namespace WHERE nspname = ?");
  return find.returning<std::int64_t>(std::string_view("fitgauge")) > 0;
}

/// A restore makes a table's indexes after its rows, and this foreign key after all of them.
constexpr const char* kIsWhole =
    "SELECT (to_regclass('fitgauge.schema_migrations') IS NOT NULL"
    " AND EXISTS (SELECT FROM pg_constraint WHERE connamespace = 'fitgauge'::regnamespace"
    " AND conname = 'table_revisions_table_set_fkey')"
    " AND NOT EXISTS (SELECT FROM pg_class t WHERE relnamespace = 'fitgauge'::regnamespace"
    " AND relkind IN ('r', 'p') AND NOT EXISTS"
    " (SELECT FROM pg_index i WHERE i.indrelid = t.oid AND i.indisvalid)))::int::int8";

/// @pre there is the schema @errors also StorageUnavailable while a restore has not ended
Result<std::size_t> taken_steps(Connection& connection) {
  sql::Statement whole(connection, kIsWhole);
  const bool is_whole = whole.returning<std::int64_t>() == 1;
  const auto steps = is_whole ? TRY(sql::check_steps(connection, migrations())) : 0;
  if (steps > 0) return static_cast<std::size_t>(steps);
  return Error{ErrorCode::StorageUnavailable,
               "the schema fitgauge of the database is incomplete: a restore has not ended, or has "
               "failed. Wait until it ends; after a failure DROP SCHEMA fitgauge CASCADE, and "
               "restore again"};
}

/// Creates the schema if it is missing, runs the missing migrations of an older version, and checks
/// the others against this build. If several daemons start at once, one does it; running daemons of
/// the older version continue.
/// @param may_change otherwise the schema must exist and be complete. @pre the connection is new.
/// @errors DatabaseNewer, DatabaseForeign; StorageUnavailable if it must not be created.
Result<void> prepare_schema(const std::string& address, bool may_change, std::int64_t now_ns) {
  Connection connection(address);
  // The number of the lock is unique to us: the first eight letters of "fitgauge".
  connection.send("BEGIN");
  connection.send("SELECT pg_advisory_xact_lock(7379538914411767653)");
  connection.wait();
  std::size_t taken = 0;
  if (has_schema(connection)) taken = TRY(taken_steps(connection));
  const auto missing = migrations().subspan(taken);
  if (!missing.empty() && !may_change) {
    return Error{ErrorCode::StorageUnavailable,
                 taken == 0 ? "the database has no schema fitgauge: start fitgauged on it once"
                            : "the database has an older schema: start fitgauged on it once"};
  }
  for (const sql::Migration& migration : missing) {
    connection.run_script(std::string(migration.sql));
    sql::record_step(connection, migration, now_ns);
  }
  connection.send("COMMIT");
  connection.wait();
  return {};
}

Error not_here(std::string_view command, std::string_view instead) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("{} is for a data folder; on PostgreSQL use {}", command, instead)};
}

/// Destroyed from the last member to the first.
class SharedDatabase final : public Database {
 public:
  SharedDatabase(const OpenOptions& chosen, const Clock& time, std::int64_t daemon)
      : options_(chosen),
        clock_(time),
        names_(chosen.names_changed),
        monitor_(chosen.health_changed),
        writer_(chosen, time, monitor_, [this, daemon] { return session(daemon); }),
        readers_(chosen, monitor_, [this, daemon] { return session(daemon); }) {
    if (chosen.access != Access::Serve) return;
    listener_.emplace(
        chosen.address, daemon, notifications_, [this](bool names) { heard(names); },
        [this](Listener::Figures figures) {
          is_away_ = !figures;
          monitor_.note(Finding::Away, figures ? "" : kNoAnswer);
          const std::lock_guard lock(figures_mutex_);
          figures_ = figures;
        });
  }

  Writer& writer() override { return writer_; }
  ReadPool& readers() override { return readers_; }

  void drain() override {
    if (listener_) listener_->end_when_away();
    readers_.stop();
    writer_.stop();
    listener_.reset();
  }

  Health health() const override { return monitor_.health(); }
  std::optional<ServerFigures> server_figures() const override {
    const std::lock_guard lock(figures_mutex_);
    return figures_;
  }

  Result<void> backup(const std::filesystem::path& /*file*/) const override {
    return not_here("backup", "pg_basebackup with archived WAL, or pg_dump --schema=fitgauge");
  }

  /// pg_amcheck checks pages, keys and references.
  Result<VerifyReport> verify(const MeasurementCheck& check) const override;

 private:
  /// While the listener does not reach the server, nobody waits for it.
  std::unique_ptr<sql::Session> session(std::int64_t daemon) {
    if (is_away_) throw StorageFailure({ErrorCode::StorageUnavailable, kNoAnswer});
    return std::make_unique<Session>(
        options_, clock_, daemon, names_, position_, notifications_,
        [this](int seconds) { return is_away_ || gives_up_statement(seconds); });
  }

  /// Records a notification, which any transaction may send for changed names.
  void heard(bool names) {
    if (names) {
      readers_.submit([](const Stores&) {}, [](const Result<void>&) {});
    }
    if (options_.committed) options_.committed();
  }

  const OpenOptions options_;
  const Clock& clock_;
  Names names_;
  Notifications notifications_;
  HealthMonitor monitor_;
  Position position_{[this](const std::string& why) { monitor_.note(Finding::SetBack, why); }};
  std::atomic<bool> is_away_{false};
  WriterThread writer_;
  ReaderThreads readers_;
  mutable std::mutex figures_mutex_;
  Listener::Figures figures_;
  std::optional<Listener> listener_;
};

constexpr std::size_t kPage = 10'000;
constexpr std::size_t kMostFindings = 100;

Result<VerifyReport> SharedDatabase::verify(const MeasurementCheck& check) const {
  try {
    VerifyReport report;
    Names names({});
    Position position;
    Notifications notifications;
    Session session(options_, clock_, 0, names, position, notifications);
    const auto note = [&](std::string finding) {
      if (report.findings.size() < kMostFindings) report.findings.push_back(std::move(finding));
    };
    session.begin_reading();
    for (const TableRevision& revision : session.stores().tables.list()) {
      const auto loaded = session.stores().tables.load(revision.number);
      if (!loaded || loaded->computed != loaded->revision.digest) {
        note("table revision " + revision.id + " differs from its digest");
      }
    }
    MeasurementFilter all;
    all.source = std::nullopt;
    all.history = true;
    std::int64_t expected = 1;
    std::optional<std::int64_t> after = 0;
    while (after) {
      after =
          session.stores().measurements.list(all, *after, kPage, [&](const MeasurementRow& row) {
            ++report.measurements;
            if (row.id != expected) {
              note("measurement m" + std::to_string(expected) + " is missing");
            }
            expected = row.id + 1;
            if (auto wrong = check ? check(row) : std::nullopt) {
              note("measurement m" + std::to_string(row.id) + " " + *wrong);
            }
          });
    }
    if (expected != session.stores().measurements.last_id() + 1) {
      note("the newest measurements are missing");
    }
    session.stores().measurements.verify_index(note);
    session.commit();
    return report;
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

}  // namespace

Result<void> check_server(const std::string& address) {
  try {
    Connection connection(address);
    if (has_schema(connection)) {
      const auto steps = taken_steps(connection);
      return steps ? Result<void>() : steps.error();
    }
    sql::Statement may(connection,
                       "SELECT has_database_privilege(current_database(), 'CREATE')::int::int8");
    if (may.returning<std::int64_t>() == 1) return {};
    return Error{ErrorCode::StorageUnavailable,
                 "the database has no schema fitgauge, and this user may not create it: GRANT "
                 "CREATE ON DATABASE, or start fitgauged once as a user who may"};
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock) {
  try {
    const bool serves = options.access == Access::Serve;
    TRY(prepare_schema(options.address, serves, clock.now().nanoseconds));
    std::int64_t daemon = 0;
    if (serves) {
      Connection connection(options.address);
      sql::Statement next(connection, "SELECT nextval('daemons') % 2000000000");
      daemon = next.returning<std::int64_t>();
    }
    return std::unique_ptr<Database>(std::make_unique<SharedDatabase>(options, clock, daemon));
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

}  // namespace fitgauge::store::postgres

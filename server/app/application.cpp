#include "app/application.hpp"

#include <fmt/format.h>

#include "app/measurements/mapping.hpp"
#include "store/database.hpp"

namespace fitgauge::app {
namespace {

constexpr std::int64_t kForEverDays = 100'000;

store::OpenOptions options_of_store(const ApplicationOptions& options) {
  store::OpenOptions open;
  open.directory = options.directory;
  open.access = options.attach ? store::Access::Attach : store::Access::Serve;
  open.synchronous = options.durable ? store::Synchronous::Full : store::Synchronous::Off;
  open.commit_each = options.commit_each;
  open.queue_limit = options.write_queue;
  open.readers = options.readers;
  open.idempotency_retention = std::chrono::days(options.idempotency_days);
  open.run_retention = std::chrono::days(
      options.run_retention_days == 0 ? kForEverDays : options.run_retention_days);
  open.event_retention = options.event_retention;
  open.around_outcomes = options.around_outcomes;
  if (options.health_changed) {
    open.health_changed = [tell = options.health_changed](const store::Health& health) {
      tell(word(health.state), health.reason);
    };
  }
  if (options.job_threw) {
    open.job_threw = [tell = options.job_threw](const Error& bug) { tell(bug.message); };
  }
  return open;
}

/// Judges a stored measurement again by the limits and the rule stored with it.
std::optional<std::string> check_verdict(const store::MeasurementRow& row) {
  Measurement again = from_store(row, [](std::int64_t) { return std::string_view(); });
  const gauging::Verdict stored = again.result.verdict;
  judge(again);
  if (again.result.verdict == stored) return std::nullopt;
  return fmt::format("measurement {} is stored as {} but its limits make it {}",
                     measurement_id_text(row.id), word(stored), word(again.result.verdict));
}

}  // namespace

Application::Application() = default;

/// Who calls the services goes before them: the runs, the listeners of commits, the storage jobs.
Application::~Application() {
  if (runs_) runs_->stop();
  committed_.stop();
  if (database_) database_->drain();
}

Result<std::unique_ptr<Application>> Application::open(const ApplicationOptions& options,
                                                       const Clock& clock) {
  std::unique_ptr<Application> app(new Application);
  store::OpenOptions open_options = options_of_store(options);
  open_options.committed = [&signal = app->committed_] { signal.raise(); };
  auto database = store::Database::open(open_options, clock);
  if (!database) return database.error();
  app->database_ = *std::move(database);
  auto tables = TableCatalog::open(*app->database_, clock);
  if (!tables) return tables.error();
  app->tables_ = *std::move(tables);
  auto keys = KeyService::open(*app->database_, clock);
  if (!keys) return keys.error();
  app->keys_ = *std::move(keys);
  app->measurements_ = std::make_unique<MeasurementService>(
      *app->database_, *app->tables_,
      MeasurementServiceOptions{.most_waiting = options.write_queue,
                                .commit_each = options.commit_each});
  app->files_ = std::make_unique<FileService>(*app->database_, clock);
  app->documents_ = std::make_unique<DocumentService>(*app->database_, clock);
  if (!options.attach) {
    app->runs_ =
        std::make_unique<RunService>(*app->database_, *app->tables_, clock,
                                     RunServiceOptions{.workers = options.run_workers,
                                                       .keeps_newest = options.keeps_newest_run});
  }
  app->events_ = std::make_unique<EventService>(*app->database_, *app->tables_, app->committed_,
                                                options.event_retention);
  return app;
}

WriterFigures Application::writer() const {
  const store::WriterCounters& counters = database_->writer_counters();
  return {.queued = database_->writer_queue(),
          .commit_seconds = counters.commit_seconds,
          .batch_jobs = counters.batch_jobs,
          .failures = counters.failed_commits,
          .log_pages = counters.log_pages};
}

Readiness Application::readiness() const { return app::readiness(*database_, *tables_); }

Result<std::optional<Timestamp>> Application::newest_measurement() const {
  return database_->readers().wait(
      [](const store::Stores& stores) -> Result<std::optional<Timestamp>> {
        std::optional<Timestamp> newest;
        stores.measurements.find(
            stores.measurements.last_id(),
            [&](const store::MeasurementRow& row) { newest = Timestamp{row.received_at_ns}; });
        return newest;
      });
}

Result<void> Application::backup(const std::filesystem::path& file) const {
  return database_->backup(file);
}

Result<Application::Verification> Application::verify() const {
  auto report = database_->verify(check_verdict);
  if (!report) return report.error();
  Verification verification{.measurements = report->measurements,
                            .findings = std::move(report->findings)};
  for (const Error& finding : tables_->state()->findings) {
    verification.findings.push_back(finding.message);
  }
  return verification;
}

}  // namespace fitgauge::app

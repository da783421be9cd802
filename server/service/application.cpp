#include "service/application.hpp"

#include "db/sqlite/data_directory.hpp"
#include "db/store/database.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"

namespace fitgauge::app {
namespace {

constexpr int kMostGlances = 100;  ///< at the checkpoint that a running daemon will sign
constexpr std::chrono::milliseconds kBetweenGlances{50};

/// Whether limits of a designation of another standard match it, if this build has that edition.
bool has_limits_of_its_standard(const Measurement& m) {
  if (m.basis != LimitsBasis::Standard) return true;
  std::string designation;
  standards::append_designation(designation, m.nominal_size, *m.class_name);
  const auto limits = standards::limits_of(designation);
  const auto is_of = [&](const standards::Standard& standard) {
    return standard.revision == m.table_revision;
  };
  const auto editions = standards::all();
  if (std::ranges::none_of(editions, is_of)) return true;
  return limits && limits->deviations == m.deviations && limits->nominal == m.nominal_size;
}

/// Judges a stored measurement again by the limits and the rule stored with it.
std::optional<std::string> check_verdict(const MeasurementRow& row, const RowNames& names) {
  Measurement again = from_store(row, names);
  if (!has_limits_of_its_standard(again)) {
    return fmt::format("m{} has limits that {} does not give by {}", row.id, *again.class_name,
                       again.table_revision);
  }
  const gauging::Verdict stored = again.result.verdict;
  judge(again);
  if (again.result.verdict == stored) return std::nullopt;
  return fmt::format("m{} is stored as {} but its limits make it {}", row.id, word(stored),
                     word(again.result.verdict));
}

constexpr std::string_view kOfNoOrigin = "is of a folder that is not known: its origin was altered";

/// The log of a checkpoint; the log of this folder, if it is of an unknown one.
std::int64_t origin_of(std::string_view note, const LogService::Logs& logs) {
  const auto checkpoint = tlog::parse_checkpoint(note);
  for (const auto& [origin, facts] : logs) {
    if (!checkpoint) break;
    if (checkpoint->origin == facts.name || facts.former.contains(checkpoint->origin)) {
      return origin;
    }
  }
  return 0;
}

/// Returns the number of measurements that a checkpoint covers.
std::uint64_t size_of(const std::string& note) {
  const auto checkpoint = tlog::parse_checkpoint(note);
  return checkpoint ? checkpoint->size : 0;
}

/// The finding of verify for a measurement that is altered, has a wrong verdict, or both.
std::optional<std::string> finding_of(const std::optional<std::string>& altered,
                                      const std::optional<std::string>& verdict) {
  if (!verdict) return altered;
  return fmt::format("{}: {}", altered.value_or("is wrong"), *verdict);
}

}  // namespace

Application::Application() = default;

/// Ends the callers of services before the services: the runs, the listeners of commits, the
/// storage jobs.
Application::~Application() {
  stage_ = Stage::Closing;
  if (jobs_) jobs_->call_off();
  if (runs_) runs_->stop();
  committed_.stop();
  if (log_) log_->stop();
  if (database_) database_->drain();
}

Result<std::unique_ptr<Application>> Application::open(const ApplicationOptions& options,
                                                       const Clock& clock) {
  std::unique_ptr<Application> app(new Application);
  store::OpenOptions open_options = options;
  const bool attach = options.access == store::Access::Attach;
  const bool is_on_server = !options.address.empty();
  if (options.log_told) {
    open_options.purged = [tell = options.log_told](const std::string& what) {
      tell("purged", what);
    };
  }
  open_options.committed = [app = app.get()] {
    app->committed_.raise();
    if (app->stage_ == Stage::Open) app->log_->committed();
  };
  if (!attach) {
    open_options.is_open = [app = app.get()] { return app->stage_ == Stage::Open; };
    open_options.check_measurement = [app = app.get()](const MeasurementRow& row) {
      return app->stage_ == Stage::Open ? app->check_leaf(row) : std::nullopt;
    };
  }
  app->directory_ = options.directory;
  app->clock_ = &clock;
  app->is_on_server_ = is_on_server;
  open_options.names_changed = [app = app.get()](const Stores& stores) {
    return app->stage_ == Stage::Open && app->take_names(stores);
  };
  if (is_on_server && !attach) {
    auto held = TRY(store::DirectoryLock::acquire(options.directory));
    app->folder_ = std::make_unique<store::DirectoryLock>(std::move(held));
  }
  app->database_ =
      TRY(options.address.empty() ? store::sqlite::open_database(open_options, clock)
                                  : store::postgres::open_database(open_options, clock));
  app->tables_ = TRY(TableCatalog::open(*app->database_, clock, options.has_centre));
  if (!attach) TRY(app->tables_->number_standards());
  app->log_ = TRY(LogService::open(*app->database_, *app->tables_, clock,
                                   {.directory = options.directory,
                                    .name = options.origin_name,
                                    .shares = is_on_server,
                                    .attach = attach,
                                    .ask_centre = options.ask_centre,
                                    .tell = options.log_told}));
  const Records records = app->records();
  app->intake_ = std::make_unique<LogIntake>(
      records, [tell = options.log_told](std::string_view event, const std::string& detail) {
        if (tell) tell(event, detail);
      });
  app->revisions_ = std::make_unique<RevisionFeed>(records);
  app->keys_ = TRY(KeyService::open(*app->database_, clock, options.log_told));
  app->measurements_ = std::make_unique<MeasurementService>(
      records, MeasurementServiceOptions{.most_waiting = options.queue_limit,
                                         .commit_each = options.commit_each});
  app->files_ = std::make_unique<FileService>(*app->database_, clock);
  app->documents_ = std::make_unique<DocumentService>(*app->database_, clock, options.has_centre);
  if (!attach) {
    app->jobs_ = std::make_unique<Jobs>(options.queue_limit);
    app->runs_ =
        std::make_unique<RunService>(records, app->jobs_->orders,
                                     RunServiceOptions{.workers = options.run_workers,
                                                       .shares = is_on_server,
                                                       .keeps_newest = options.keeps_newest_run});
  }
  app->events_ = std::make_unique<EventService>(records, app->committed_, options.event_retention);
  if (!attach) app->log_->start();
  app->stage_ = Stage::Open;
  return app;
}

/// Rows that other daemons have added.
bool Application::take_names(const Stores& stores) {
  tables_->take(stores);
  log_->take_names(stores);
  return true;
}

std::optional<tlog::Hash> Application::kept_node(std::int64_t origin,
                                                 const tlog::Node& node) const {
  std::optional<tlog::Hash> kept;
  const auto read = database_->readers().wait([&](const Stores& stores) {
    const int level = static_cast<int>(node.level / tlog::kTileHeight);
    const auto index = static_cast<std::int64_t>(node.index);
    const auto take = [&](const Digest& hash) { kept = hash; };
    if (origin == 0) {
      stores.log.nodes(level, index, 1, take);
    } else {
      stores.origins.nodes(origin, level, index, 1, take);
    }
  });
  return read ? kept : std::nullopt;
}

Readiness Application::readiness() const {
  Readiness readiness{.findings = tables_->state()->findings, .database = "ok"};
  const store::Health health = database_->health();
  if (health.state == store::HealthState::Checking) {
    readiness.database = "checking";
  } else if (health.state != store::HealthState::Ok) {
    const bool is_damaged = health.state == store::HealthState::Damaged;
    readiness.findings.push_back(
        {is_damaged ? ErrorCode::StorageCorrupt : ErrorCode::StorageUnavailable, health.reason,
         "database"});
  }
  if (auto forked = log_->forked()) readiness.findings.push_back(*std::move(forked));
  return readiness;
}

Result<std::optional<Timestamp>> Application::newest_measurement() const {
  return database_->readers().wait(
      [](const Stores& stores) { return stores.measurements.newest_received_at(); });
}

Result<std::string> Application::backup(const std::filesystem::path& file) const {
  // Reads the checkpoint first: the copy is made after it, and so has everything it covers. A
  // running daemon signs its rows within a second.
  const auto stored = [this] {
    const auto rows = database_->readers().wait(
        [](const Stores& stores) { return stores.measurements.log_size(); });
    return static_cast<std::uint64_t>(rows ? *rows : 0);
  };
  const std::uint64_t wanted = stored();
  const auto newest = [this] {
    const auto note = read_small_file(directory_ / kCheckpointFile);
    return note && *note ? **note : std::string();
  };
  std::string checkpoint = newest();
  for (int glance = 0; size_of(checkpoint) < wanted && glance < kMostGlances; ++glance) {
    std::this_thread::sleep_for(kBetweenGlances);
    checkpoint = newest();
  }
  TRY(database_->backup(file));
  if (!checkpoint.empty()) {
    auto beside = file;
    TRY(keep_file(beside += ".checkpoint", checkpoint, true));
  }
  const std::uint64_t covered = size_of(checkpoint);
  if (checkpoint.empty() && wanted > 0)
    return "it has no checkpoint: the service signs its measurements at the next start";
  if (covered < wanted) {
    return fmt::format(
        "its checkpoint covers {} of {} measurements: the service signs the others at the next "
        "start",
        covered, wanted);
  }
  if (const std::uint64_t now = stored(); covered > now) {
    return fmt::format(
        "its checkpoint covers {} measurements, and the database has only {}: it is an older copy, "
        "and the service was not started on it yet",
        covered, now);
  }
  return fmt::format("its checkpoint covers the {} measurements stored before it", covered);
}

RevisionIntake Application::revision_intake(Tell tell) { return {records(), std::move(tell)}; }

std::optional<std::string> Application::check_leaf(const MeasurementRow& row) const {
  const Digest leaf = LeafMaker()(from_store(row, row_names(*tables_, log_->origins())));
  return leaf == row.hash ? std::nullopt : std::optional(altered_finding());
}

/// Reads the names again for rows that another daemon has stored since the start.
RowNames Application::later_names() const {
  const auto read = [this] {
    (void)database_->readers().wait([this](const Stores& stores) {
      tables_->remember(stores);
      for (const auto& origin : stores.origins.list()) {
        log_->origins().remember(origin.number, origin.digits);
      }
    });
  };
  const RowNames known = row_names(*tables_, log_->origins());
  return {.revision_id =
              [=](std::int64_t number) {
                if (known.revision_id(number).empty()) read();
                return known.revision_id(number);
              },
          .origin =
              [=](std::int64_t origin, std::int64_t number) {
                if (known.origin(origin, number).empty()) read();
                return known.origin(origin, number);
              }};
}

Result<Application::Verification> Application::verify(
    const std::map<std::string, std::string>& checkpoints) const {
  // Reads the daemon's own checkpoints before the rows, so that the rows have everything they
  // cover.
  auto notes = checkpoints;
  for (const TreeNames& tree : {kTreeOfMeasurements, kTreeOfChanges}) {
    const auto file = directory_ / tree.file;
    const auto own = read_small_file(file);
    if (own && *own && !(*own)->empty()) notes.emplace(file.string(), **own);
  }
  const RowNames names = later_names();
  const auto logs = LogService::logs(*database_);
  if (!logs && logs.error().code != ErrorCode::StorageCorrupt) return logs.error();
  if (!logs) {  // the log contradicts itself: a finding, and there may be more
    return verification_of(database_->verify([&](const MeasurementRow& row) {
      return finding_of(std::nullopt, check_verdict(row, names));
    }));
  }
  std::map<std::int64_t, LogCheck> checks;
  for (const auto& [origin, facts] : *logs) {
    const auto kept = [this, number = origin](const tlog::Node& node) {
      return kept_node(number, node);
    };
    const auto nodes =
        origin == LogReader::kChanges ? LogCheck::KeptNodes() : LogCheck::KeptNodes(kept);
    LogCheck& check = checks.try_emplace(origin, facts, names, nodes).first->second;
    if (!facts.checkpoint.empty()) check.expect("its newest checkpoint", facts.checkpoint);
  }
  for (const auto& [place, note] : notes) checks.at(origin_of(note, *logs)).expect(place, note);
  auto report = database_->verify([&](const MeasurementRow& row) {
    const auto check = checks.find(row.origin.value_or(0));
    std::optional<std::string> altered;
    if (check != checks.end()) {
      altered = check->second.add(row);
    } else if (names.origin(row.origin.value_or(0), row.id).empty()) {
      altered = kOfNoOrigin;  // not of a station whose first rows arrive meanwhile
    }
    return finding_of(altered, check_verdict(row, names));
  });
  auto verification = verification_of(std::move(report));
  if (!verification) return verification;
  const bool has_changes = checks.at(LogReader::kChanges).add_changes(*database_);
  for (auto& [origin, check] : checks) {
    const bool is_shown = origin != LogReader::kChanges || has_changes;
    if (is_shown && origin != 0) verification->head += '\n';
    if (is_shown) verification->head += check.head_text();
    const auto& facts = logs->at(origin);
    for (const auto& [place, note] : checkpoints) {
      const auto known = tlog::parse_checkpoint(note);
      if (!known || known->size == 0) continue;
      if (known->origin != facts.name && !facts.former.contains(known->origin)) continue;
      verification->head +=
          known->size <= static_cast<std::uint64_t>(facts.size)
              ? fmt::format("\n{} covers {} of {} {}", place, known->size, facts.size, facts.leaves)
              : fmt::format(
                    "\n{} covers {} {}, and the database has only {}: it is newer than this "
                    "copy",
                    place, known->size, facts.leaves, facts.size);
    }
    for (std::string& finding : check.finish()) {
      verification->findings.push_back(std::move(finding));
    }
  }
  return verification;
}

Result<Application::Verification> Application::verification_of(
    Result<store::VerifyReport> report) const {
  if (!report) return report.error();
  Verification verification{
      .measurements = report->measurements, .findings = std::move(report->findings), .head = {}};
  for (const Error& finding : tables_->state()->findings) {
    verification.findings.push_back(finding.message);
  }
  return verification;
}

}  // namespace fitgauge::app

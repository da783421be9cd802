#pragma once

#include "db/store/database.hpp"
#include "service/documents/document_service.hpp"
#include "service/events/event_service.hpp"
#include "service/jobs.hpp"
#include "service/log/log_forwarding.hpp"
#include "service/revisions/revisions.hpp"
#include "service/runs/run_service.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {

/// Options of the database, and of the services on it. `directory` has the log's key also if the
/// database is on a server; check_measurement, is_open, names_changed and committed are set here.
struct ApplicationOptions : store::OpenOptions {
  unsigned run_workers = 2;
  bool keeps_newest_run = false;  ///< see RunServiceOptions
  /// Asks the centre for the state of this log; see LogOptions.
  std::function<std::optional<AtCentre>(std::string_view digits)> ask_centre{};
  bool has_centre = false;              ///< documents of a centre can only be changed there
  std::string origin_name = "station";  ///< of the log; see LogOptions
  Tell log_told{};  ///< receives events of the log, and what the storage has purged
};

/// The service without its network: the database and one object per use case. Thread-safe after
/// open(). The destructor finishes queued work, commits, checkpoints and closes.
class Application {
 public:
  /// @errors those of the database's opening (DatabaseInUse, DatabaseForeign, DatabaseNewer,
  ///   StorageCorrupt, StorageUnavailable). Tables that fail their audit are not an error here.
  static Result<std::unique_ptr<Application>> open(const ApplicationOptions& options,
                                                   const Clock& clock);
  ~Application();

  TableCatalog& tables() { return *tables_; }
  LogService& log() { return *log_; }
  LogIntake& intake() { return *intake_; }
  RevisionFeed& revisions() { return *revisions_; }
  /// Stores revisions from the centre.
  RevisionIntake revision_intake(Tell tell);
  LogOutbox outbox() { return {*database_, *tables_, *log_}; }
  MeasurementService& measurements() { return *measurements_; }
  EventService& events() { return *events_; }
  KeyService& keys() { return *keys_; }
  FileService& files() { return *files_; }
  DocumentService& documents() { return *documents_; }
  /// @pre not attached.
  Jobs& jobs() { return *jobs_; }
  RunService& runs() { return *runs_; }

  Readiness readiness() const;
  /// For metrics.
  Database& database() const { return *database_; }
  bool is_on_server() const { return is_on_server_; }  ///< not in files of the data folder

  // These block: for the start and for commands.

  /// Returns the time of the newest measurement; none before the first. @errors StorageUnavailable.
  Result<std::optional<Timestamp>> newest_measurement() const;

  /// Writes a consistent copy of the database, and next to it (`FILE.checkpoint`) the newest
  /// checkpoint, which the copy contains. Returns what it covers, in words.
  /// @errors StorageUnavailable, also if the file exists.
  Result<std::string> backup(const std::filesystem::path& file) const;

  struct Verification {
    std::int64_t measurements = 0;
    std::vector<std::string> findings;  ///< empty: all is well
    std::string head;  ///< the logs as they were found: name, size and root of each
  };
  /// Checks the file, the schema, every table revision, the log against the signatures of this
  /// folder and `checkpoints` (notes by their names), and that each verdict follows from the stored
  /// limits.
  Result<Verification> verify(const std::map<std::string, std::string>& checkpoints = {}) const;

 private:
  Application();
  Result<Verification> verification_of(Result<store::VerifyReport> report) const;
  bool take_names(const Stores& stores);
  std::optional<std::string> check_leaf(const MeasurementRow& row) const;
  Records records() const { return {*database_, *tables_, log_->origins(), *clock_}; }
  RowNames later_names() const;
  std::optional<tlog::Hash> kept_node(std::int64_t origin, const tlog::Node& node) const;

  // Declared in the order of construction: each member uses only those above it.
  std::filesystem::path directory_;
  bool is_on_server_ = false;
  const Clock* clock_ = nullptr;
  CommitSignal committed_;
  enum class Stage { Opening, Open, Closing };
  std::atomic<Stage> stage_ = Stage::Opening;
  std::unique_ptr<store::DirectoryLock> folder_;  ///< of a daemon whose database is on a server
  std::unique_ptr<Database> database_;
  std::unique_ptr<TableCatalog> tables_;
  std::unique_ptr<LogService> log_;
  std::unique_ptr<LogIntake> intake_;
  std::unique_ptr<RevisionFeed> revisions_;
  std::unique_ptr<MeasurementService> measurements_;
  std::unique_ptr<EventService> events_;
  std::unique_ptr<KeyService> keys_;
  std::unique_ptr<FileService> files_;
  std::unique_ptr<DocumentService> documents_;
  std::unique_ptr<Jobs> jobs_;
  std::unique_ptr<RunService> runs_;
};

}  // namespace fitgauge::app

#pragma once

#include <filesystem>

#include "base/thread.hpp"
#include "db/store/log_store.hpp"
#include "proof/note.hpp"
#include "record/measurement.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

class LogReader;
struct TreeNames;

/// The state of a history at the centre.
struct AtCentre {
  std::string centre{};   ///< digits of the centre's present history
  std::int64_t rows = 0;  ///< of the history in question that are there
  std::int64_t note = 0;  ///< number of its newest note there; 0: there is none
  bool is_branched = false;
};

struct LogOptions {
  std::filesystem::path directory;  ///< of the database, with the key and the newest checkpoint
  std::string name = "station";     ///< of the log, as long as it is empty
  bool shares = false;              ///< several daemons sign this log
  bool attach = false;              ///< next to a running daemon: nothing is signed or written
  /// Returns the centre's state of the history with these digits; none if it does not respond.
  /// Called once, when the log is opened; not set without a centre. May block.
  std::function<std::optional<AtCentre>(std::string_view digits)> ask_centre{};
  Tell tell{};
};

/// The log of the data folder: a Merkle tree over its measurements that grows after the commits,
/// and its head, signed at most once a second. Writers never wait for it. Thread-safe.
class LogService {
 public:
  /// Reads the log's name and keys, creates them at the first start, and signs the tree. Stored
  /// rows that are not in the tree follow in the background. If the database may be an older copy
  /// of one with more ids, a branch begins: another origin, name and key.
  /// @errors StorageUnavailable, StorageCorrupt, KeyMalformed.
  static Result<std::unique_ptr<LogService>> open(Database& database, const TableCatalog& tables,
                                                  const Clock& clock, LogOptions options);
  ~LogService();

  /// The end of new ids of this folder: the first 16 hexadecimal digits of its origin.
  std::string_view origin() const { return origins_.own(); }
  /// Origins of all folders with records here.
  Origins& origins() { return origins_; }

  /// Starts the thread that extends the tree, and logs the head once a day.
  void start();
  /// Signs once more before it returns, so that the folder knows the last stored row: an older copy
  /// then cannot use its ids again.
  void stop() { thread_.stop(); }
  /// There may be new measurements. Called after each commit; does not block.
  void committed();

  struct Head {
    tlog::Checkpoint checkpoint;
    std::string note;  ///< the checkpoint, signed
  };
  /// A reader of the log of this folder or, by its number, of an origin. Used inside a job.
  LogReader reader(const Stores& stores, std::int64_t origin = 0) const;
  /// @pre not attached.
  std::shared_ptr<const Head> head() const { return head_.get(); }
  std::string head_text() const;  ///< for people

  /// Reports that two folders continue this history: no measurement is stored until the centre
  /// accepts the rows again. @param why none: it accepts them. Blocks. @errors those of storage.
  Result<void> set_forked(const std::optional<std::string>& why);
  std::optional<Error> forked() const;

  /// The rows of this log under one name, after `begin` up to `end`.
  struct History {
    std::string digits;  ///< end of their ids
    std::string name;    ///< in checkpoints
    std::int64_t begin = 0;
    std::optional<std::int64_t> end{};         ///< none: the present one
    std::optional<tlog::SigningKey> signer{};  ///< none: the key was lost
  };
  /// Origin of a place in the log.
  const History& history_of(std::int64_t place) const;
  /// @pre it is one of this folder
  const History& history_of(std::string_view digits) const;

  /// Loads origins and keys that other daemons have added. Used inside a job.
  /// @throws store::StorageFailure if one of them has begun a branch: this daemon continues the
  /// history below it, and must be restarted.
  void take_names(const Stores& stores);

  /// The public keys, one a line, the newest first.
  std::string verifier_keys() const { return *verifier_keys_.get(); }

  struct Proof {
    std::uint64_t index = 0;
    tlog::Hash leaf{};
    std::vector<tlog::Hash> path;
    std::shared_ptr<const Head> head;
  };
  /// Proves that a measurement is in the tree of a signed head. For a forwarded one, that is the
  /// head of its station, countersigned here. Waits up to 1.1 s for such a head.
  /// @errors MeasurementUnknown, StorageUnavailable, StorageBusy.
  void prove(const RecordName& name, Done<Proof> done);

  struct TileBytes {
    std::string bytes;
    bool is_full = false;  ///< it never changes
  };
  /// @param path after `tile/`. @param of_changes true for the tree of changes.
  /// @errors NotFound; those of storage.
  void tile(std::string_view path, bool of_changes, Done<TileBytes> done);

  struct ChangePage {
    std::vector<std::string> changes;  ///< as JSON
    std::string last;                  ///< id of the newest so far; empty: there is none
    bool has_more = false;
  };
  /// Returns a page of changes after an id, or after a number of the first history, oldest first.
  /// @errors CursorInvalid after the end of its history; those of storage.
  void changes(store::ChangeFilter filter, std::string after, std::int64_t limit,
               Done<ChangePage> done) const;
  /// Returns the signed head of the tree of all changes, after storing it in the folder. Its name
  /// is the log's name with `/changes`, to distinguish it from heads of the measurements.
  /// @errors those of storage.
  void changes_head(Done<std::string> done);
  /// The keys of that name: verifier_keys() under it.
  std::string changes_keys() const;

  /// The current state of the log for verification.
  struct Facts {
    std::string name;
    std::int64_t size = 0;
    std::vector<tlog::VerifierKey> keys;
    std::string checkpoint{};  ///< for forwarded logs, the newest one in the database
    tlog::Frontier base{};     ///< of a branch that was forwarded: the rows below it
    /// Its earlier names, and the number of rows of each that it continues.
    std::map<std::string, std::uint64_t> former{};
    /// true at a centre: only its corrections of this folder's records are here.
    bool is_partial = false;
    std::string_view leaves = "measurements";
  };
  /// Logs by origin: 0 is this folder, the last origin is its changes.
  using Logs = std::map<std::int64_t, Facts>;
  static Result<Logs> logs(Database& database);

  /// Returns the head of the first `size` measurements of this folder, signed for a history that
  /// has its signer. It is not published as the newest one. @pre the tree has so many. Used inside
  /// a read job.
  std::string sign_at(const Stores& stores, const History& history, std::uint64_t size) const;

  /// Checkpoints that two consecutive keys signed, as stored in the folder.
  std::vector<std::string> hand_overs() const;

 private:
  using Steady = std::chrono::steady_clock;
  struct Waiter {
    RecordName name{};
    std::uint64_t index = 0;
    Steady::time_point deadline;
    Done<Proof> done;
  };

  LogService(Database& database, const TableCatalog& tables, const Clock& clock,
             LogOptions options);

  struct Loaded;
  Result<Loaded> read() const;
  Result<void> settle_place(Loaded& loaded);
  Result<void> keep_place() const;
  Result<void> load();
  Result<void> load_keys(const std::vector<std::string>& known);
  Result<void> write_keys() const;
  void set_aside(std::string_view name, std::string_view why);
  Result<tlog::Hash> root_of(const TreeNames& tree, std::uint64_t size) const;
  std::optional<std::string> told_by(const TreeNames& tree, std::int64_t leaves,
                                     const Loaded& loaded);
  std::optional<std::string> told_by_checkpoint(const Loaded& loaded);
  std::optional<std::string> why_to_branch(Loaded& loaded);
  Result<void> branch(const Loaded& loaded, const std::string& why);
  void run(const std::stop_token& stop);
  Steady::time_point next_wake() const;
  using IsOver = std::function<bool()>;
  Result<void> grow(const IsOver& is_over);
  struct Stretch;
  Result<void> take_leaves(const IsOver& is_over, Stretch& stretch);
  void sign();
  Result<void> keep(const TreeNames& tree, const std::string& note) const;
  void tell(std::string_view event, const std::string& detail) const;
  void end_waiters(std::unique_lock<std::mutex>& lock);
  Result<Proof> read_proof(const Stores& stores, const RecordName& name);
  std::shared_ptr<const Head> countersigned(const Stores& stores, std::int64_t origin) const;

  Database& database_;
  const TableCatalog& tables_;
  const Clock& clock_;
  const LogOptions options_;
  Origins origins_;
  std::string name_;
  std::vector<History> histories_;          ///< the oldest first, the present one last
  Snapshot<std::string> forked_;            ///< why nothing is recorded; empty: it is
  std::vector<tlog::SigningKey> signers_;   ///< the current key, and once its predecessor
  std::vector<tlog::SigningKey> older_;     ///< keys of former histories
  std::optional<tlog::SigningKey> signer_;  ///< the key in use
  Snapshot<std::string> verifier_keys_;
  Snapshot<Head> head_;
  std::mutex changes_mutex_;
  std::optional<Head> changes_head_;  ///< the newest; under changes_mutex_
  tlog::Frontier frontier_;           ///< of the thread

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  bool dirty_ = true;
  bool stopped_ = false;
  Steady::time_point next_signing_{};
  Steady::time_point next_telling_{};
  std::vector<Waiter> waiters_;
  Thread thread_;
};

}  // namespace fitgauge::app

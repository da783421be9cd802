#pragma once

#include "base/clock.hpp"
#include "base/digest.hpp"
#include "base/thread.hpp"
#include "service/storage.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {

/// The current tolerance tables. Every reader gets them here, so all see one revision.
struct TableState {
  std::shared_ptr<const iso286::ToleranceTables> tables;  ///< null if the audit has findings
  std::int64_t number = 0;                                ///< of the revision, as the store counts
  std::vector<Error> findings;  ///< findings of the audit: table, range and column each
};

/// Keeps the tables: imports the compiled-in ones as the first revision, audits and loads the
/// latest, stores custom tolerance classes as new revisions. Thread-safe; callbacks come on a
/// storage thread.
class TableCatalog {
 public:
  using Tables = std::shared_ptr<const iso286::ToleranceTables>;

  /// Loads the latest revision, or imports the compiled-in tables into a new database. Tables that
  /// fail their audit are not an error here: see state().
  /// @param has_centre whether tables of a centre can only be changed there.
  /// @errors StorageUnavailable, StorageCorrupt.
  static Result<std::unique_ptr<TableCatalog>> open(Database& database, const Clock& clock,
                                                    bool has_centre = false);

  std::shared_ptr<const TableState> state() const { return state_.get(); }
  /// Whether `kept`, a state of the caller, is still in use.
  bool is_in_use(const TableState* kept) const { return state_.is(kept); }

  /// The tables in use. @errors TablesInconsistent with the audit's findings.
  Result<Tables> tables() const;

  /// The tables of a stored revision. @errors RevisionUnknown, TablesInconsistent,
  /// StorageUnavailable.
  void at_revision(std::string revision, Done<Tables> done);

  struct ColumnName {
    iso286::Feature feature = iso286::Feature::Hole;
    std::string name;
  };
  struct ColumnStored {
    bool created = false;  ///< there was no custom column of that name
    std::string revision;
  };
  /// Decides whether a change may follow a revision, in which the column is custom or is not.
  using Condition = std::function<bool(std::string_view revision, bool exists)>;
  /// Stores the column in a new revision, which every reader then sees, and the event
  /// `table.changed`.
  /// @param caller key name of the sender of the change.
  /// @errors TableRowsInvalid, PreconditionFailed, Forbidden (the centre's), StorageUnavailable,
  ///   StorageBusy.
  void put_column(iso286::CustomColumn column, Condition condition,
                  std::optional<std::string> caller, Done<ColumnStored> done);

  /// Tables of a centre, stored and not yet in force.
  struct Received {
    std::int64_t number = 0;
    std::string id{};
    Digest digest{};
    std::shared_ptr<const TableState> state{};  ///< null: they are in force already
    bool replaced_own = false;                  ///< the replaced tables had custom classes
    std::string replaced_id{};
    Digest replaced_digest{};
  };
  /// Stores the tables of a centre under its id. Used inside a write job, whose transaction
  /// continues.
  /// @errors TablesInconsistent: the standard's tables differ there, or the columns break a rule.
  Result<Received> receive(Stores& stores, const std::string& id,
                           const std::vector<iso286::CustomColumn>& columns, std::int64_t now_ns);
  /// Shows them to every reader. @pre they are committed
  void put_in_force(const Received& received);

  /// Loads revisions that other daemons have stored; the newest becomes current. Used inside a job.
  void take(const Stores& stores);

  /// The id of a revision by its number, for reading stored rows; valid as long as the catalog.
  /// Empty for a number that was never given.
  std::string_view revision_id(std::int64_t number) const;
  /// Loads a revision of another folder, under a number below 0.
  void remember(std::int64_t number, std::string_view id);
  /// Loads the ids of all revisions. Used inside a job.
  /// @returns the number of the newest of this folder
  std::int64_t remember(const Stores& stores);

  /// Numbers the editions of the other standards that measurements use, if they have no number yet.
  /// @errors StorageUnavailable.
  Result<void> number_standards();

  /// Numbers revisions of others that have no number yet, in a commit before their rows, so that
  /// every reader of a row knows their names. Empty ids are left out. Blocks.
  /// @errors StorageUnavailable, StorageBusy.
  Result<void> number_revisions(std::set<std::string_view> ids);
  /// The number of a revision that revision_id knows.
  std::optional<std::int64_t> revision_number(std::string_view id) const;

  /// Returns to the standard. @errors ClassUnknown if the class is not custom; those of put_column.
  void remove_column(iso286::Feature feature, std::string name, Condition condition,
                     std::optional<std::string> caller, Done<ColumnStored> done);

 private:
  TableCatalog(Database& database, const Clock& clock, bool has_centre)
      : database_(database), clock_(clock), has_centre_(has_centre) {}

  void put_in_force(std::shared_ptr<const TableState> state);

  void change(ColumnName column, std::optional<iso286::CustomColumn> to, Condition condition,
              std::optional<std::string> caller, Done<ColumnStored> done);

  Database& database_;
  const Clock& clock_;
  const bool has_centre_;
  Snapshot<TableState> state_;
  std::mutex state_mutex_;
  mutable std::mutex ids_mutex_;
  std::map<std::int64_t, std::string> ids_;  // never erased: views of the texts are given out
};

}  // namespace fitgauge::app

#pragma once

#include "db/store/log_store.hpp"
#include "record/measurement.hpp"
#include "service/documents/key_service.hpp"
#include "service/storage.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {

/// Refuses to change a document of the centre at a station. @param what `the plan 'X'`
inline Error centre_decides(std::string_view what) {
  return {ErrorCode::Forbidden,
          std::string(what) +
              " must be changed at the centre: the change arrives here within half a minute"};
}

using store::RevisionKind;

/// `tables`, `key`, `setup`, `plan`, `correction`, `catalogue`.
std::string_view word(RevisionKind kind);
std::optional<RevisionKind> revision_kind_from_word(std::string_view text);

/// Change `number` of a centre: a document that it sets or removes. Members of other kinds are
/// empty.
struct Revision {
  std::int64_t number = 0;
  RevisionKind kind = RevisionKind::Tables;
  std::string name{};       ///< of the key or document
  bool is_removed = false;  ///< a key: revoked
  std::string text{};       ///< of the document, or the correction's record

  std::string id{};  ///< of the tables, as records name them
  std::vector<iso286::CustomColumn> columns{};

  Role role = Role::Viewer;
  Digest token_hash{};
  std::optional<Timestamp> expires_at{};

  std::int64_t place = 0;                    ///< of the correction in the centre's log
  std::optional<Measurement> measurement{};  ///< content of `text`, if it was read
};

/// Revisions in the order of their numbers.
struct RevisionPage {
  std::string position{};  ///< the next page is asked for with it
  bool more = false;
  std::string origin{};   ///< of the centre: 16 hexadecimal digits
  std::int64_t size = 0;  ///< records of the station's log that are at the centre
  /// Number of the station's newest note at the centre; none: the centre accepts no notes.
  std::optional<std::int64_t> notes{};
  bool is_branched = false;  ///< the centre has a branch of the station's log
  std::vector<Revision> revisions{};
};

/// Revisions of this centre for its stations: tables with custom classes, keys of viewers and
/// operators by their hashes, setups, plans, and corrections of a station's records. Thread-safe.
class RevisionFeed : Records {
 public:
  explicit RevisionFeed(const Records& records) : Records(records) {}

  /// Returns the changes after a position; all changes if this folder did not give the position
  /// out. Of each document only the last revision.
  /// @param station digits of its origin, for its corrections.
  /// @errors those of storage.
  void read(std::string_view station, std::string position, Done<RevisionPage> done) const;

 private:
  Result<RevisionPage> page(const Stores& stores, std::string_view station,
                            std::string_view position) const;
  bool fill(const Stores& stores, const std::string& name, Revision& revision) const;
};

/// Stores revisions of the centre at a station. They replace documents of the same name here;
/// documents that this folder has made are renamed, and a key of this folder stays. Other documents
/// do not change. Used by one thread.
class RevisionIntake : Records {
 public:
  RevisionIntake(const Records& records, Tell tell) : Records(records), tell_(std::move(tell)) {}

  struct Outcome {
    int taken = 0;    ///< that were new here
    int refused = 0;  ///< that cannot be stored here; reported, each once
  };
  /// Stores all of a page in one transaction. A repeated page changes nothing. Blocks.
  /// @errors those of storage.
  Result<Outcome> take(const RevisionPage& page);

 private:
  struct Job;

  Result<void> prepare(const RevisionPage& page);
  void tell_once(std::string_view event, const std::string& detail);

  const Tell tell_;
  std::set<std::string> told_{};
};

}  // namespace fitgauge::app

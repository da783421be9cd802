#pragma once

#include "base/digest.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store {

/// The log of the measurements of a data folder: its origin, its keys, and the stored nodes of its
/// tree. The leaves are in the measurements (MeasurementsStore::log_hashes).
class LogStore : public OnConnection<LogStore> {
 public:
  struct State {
    std::array<std::uint8_t, 16> origin{};  ///< random, made with the database, never changed
    std::optional<std::string> name{};      ///< first words of its checkpoints; none: not set yet
    std::int64_t size = 0;                  ///< rows that are in the tree
  };
  State state() const;

  /// Sets the name, once, at the first start.
  void set_name(std::string_view name);

  /// An earlier history than the current one of state(), and its part that continues in the next
  /// one.
  struct Branch {
    std::array<std::uint8_t, 16> origin{};
    std::string name{};
    std::int64_t size = 0;  ///< rows of its tree
    /// The newest numbers in ids that it gave out: of measurements, runs, events and notes.
    std::array<std::int64_t, 4> newest{};
  };
  std::vector<Branch> branches() const;  ///< the oldest first
  /// Returns the last change of an ended history by its name; 0 if the history is unknown.
  std::int64_t last_change(std::string_view history) const;
  /// Facts about the database, each with a text.
  enum class Mark : std::uint8_t {
    Copy,      ///< it is a copy that `backup` made and nobody has started
    Forked,    ///< why no measurement is recorded: the centre has another log of this name
    Centre,    ///< digits of the last history of the centre that this folder has met
    Place,     ///< place() where the ids of this log were last given out
    Retention  ///< the text of Retention
  };
  std::optional<std::string> mark(Mark mark) const;
  /// @param reason none: removes the mark
  void set_mark(Mark mark, const std::optional<std::string>& reason);
  /// Returns where the database is: server, database and timeline of PostgreSQL; empty for a file.
  std::string place() const;
  /// Ends the history that state() names with the `size` rows there are, and begins another.
  void begin_branch(std::int64_t size, const std::array<std::uint8_t, 16>& origin,
                    std::string_view name);

  /// The public keys (vkeys) that have signed, the newest first.
  std::vector<std::string> keys() const;
  void add_key(std::string_view vkey, std::int64_t now_ns);

  /// The root of 256^level leaves, the `index`-th of its level.
  struct Node {
    int level = 0;  ///< 1 and up
    std::int64_t index = 0;
    Digest hash{};
  };
  /// Sets the size of the tree and keeps the nodes that were completed.
  void grow(std::int64_t size, std::span<const Node> nodes);

  using Visitor = std::function<void(const Digest&)>;
  /// Visits the nodes of a level from `first` on. @returns how many there were, at most `count`.
  std::int64_t nodes(int level, std::int64_t first, std::int64_t count, const Visitor& visit) const;
};

/// Other data folders whose stations forward records to this one, and the forwarded part of the log
/// of this folder.
class OriginsStore : public OnConnection<OriginsStore> {
 public:
  struct Origin {
    std::int64_t number = 0;                  ///< in MeasurementRow::origin, from 1 on
    std::string digits{};                     ///< end of its ids
    std::optional<std::int64_t> first_row{};  ///< the id of its first row here
    std::int64_t size = 0;                    ///< its rows that are here
    std::string checkpoint{};                 ///< its signed head; empty before the first
  };
  std::vector<Origin> list() const;  ///< by number
  std::optional<Origin> find(std::string_view digits) const;
  std::optional<Origin> find(std::int64_t number) const;

  /// @returns its number.
  std::int64_t add(std::string_view digits);
  /// Its head after more rows came. `first_row` is set with the first of them.
  void set_head(const Origin& origin);

  /// Public keys whose checkpoints are accepted, the oldest first.
  std::vector<std::string> keys(std::int64_t origin) const;
  void add_key(std::int64_t origin, std::string_view vkey, std::int64_t now_ns);

  /// Log from which this log branched, and the number of its rows in this one.
  struct Base {
    std::int64_t origin = 0;
    std::int64_t size = 0;
  };
  std::optional<Base> base(std::int64_t origin) const;
  bool is_base(std::int64_t origin) const;  ///< of a branch
  void set_base(std::int64_t origin, const Base& base);

  /// Keeps nodes of its tree, as LogStore::grow.
  void keep_nodes(std::int64_t origin, std::span<const LogStore::Node> nodes);
  /// Visits nodes like LogStore::nodes.
  std::int64_t nodes(std::int64_t origin, int level, std::int64_t first, std::int64_t count,
                     const LogStore::Visitor& visit) const;

  /// Adds a signed head that contradicts the log: the folder was copied and started twice.
  /// @returns false: this one is known.
  bool add_fork(std::int64_t origin, std::string_view checkpoint, std::int64_t now_ns);

  struct Revision {
    std::int64_t number = 0;  ///< rows name it by the negative of this
    std::string id{};
  };
  /// The table revisions that judged forwarded records and are not here.
  std::vector<Revision> revisions() const;
  /// @returns its number; it may be known already.
  std::int64_t add_revision(std::string_view id);

  struct Forwarded {
    std::string centre{};
    std::int64_t size = 0;  ///< rows of this folder's own log that the centre has confirmed
  };
  std::optional<Forwarded> forwarded() const;
  void set_forwarded(const Forwarded& forwarded);
};

/// The codes are stored: never change or reuse one. Setup, Plan and Catalogue are those of
/// documents.
enum class RevisionKind : std::uint8_t {
  Tables = 1,
  Key = 2,
  Setup = 3,
  Plan = 4,
  Correction = 5,
  Catalogue = 7
};
constexpr RevisionKind last_of(RevisionKind) { return RevisionKind::Catalogue; }

/// Changes of a centre for its stations, and the part that a station has of them. Changes of
/// tables, keys, setups, plans and catalogues number themselves; corrections are numbered by
/// MeasurementsStore::append().
class RevisionsStore : public OnConnection<RevisionsStore> {
 public:
  struct Revision {
    std::int64_t number = 0;
    RevisionKind kind = RevisionKind::Tables;
    std::string name{};  ///< of a correction: the id of its row
  };
  /// Returns up to `limit` revisions for this station after `after`, only the last one of each
  /// document.
  std::vector<Revision> list(std::int64_t after, std::int64_t station, std::int64_t limit) const;

  /// `17-5f0c9a3e77d21b40`, the number and its random tag; `0` before the first.
  std::string newest_position() const;
  std::string position(std::int64_t number) const;
  /// Number of a position; none if this folder did not return it.
  std::optional<std::int64_t> number_of(std::string_view position) const;

  struct Received {
    std::int64_t number = 0;
    Digest digest{};  ///< of the content as written here
  };
  std::optional<Received> received(RevisionKind kind, std::string_view name) const;
  void set_received(RevisionKind kind, std::string_view name, const Received& received);
  void forget_received(RevisionKind kind, std::string_view name);
};

/// A change of something that decides on verdicts or rights: a table, a document or a key.
struct Change {
  std::int64_t id = 0;  ///< 1, 2, … without gaps
  std::int64_t at_ns = 0;
  std::optional<std::string> caller{};
  std::string kind{};
  std::string name{};
  std::string action{};
  std::optional<std::string> before{};  ///< JSON; none: it did not exist
  std::optional<std::string> after{};   ///< JSON; none: deleted
};

struct ChangeFilter {
  std::optional<std::string> kind{};
  std::optional<std::string> name{};
  std::optional<std::int64_t> from_ns{};
  std::optional<std::int64_t> to_ns{};  ///< before then
};

/// The changes, kept for ever: the database refuses UPDATE and DELETE.
class ChangesStore : public OnConnection<ChangesStore> {
 public:
  std::int64_t size() const;
  /// @pre its id is size() + 1. @param leaf its hash in the tree of changes
  void append(const Change& change, const Digest& leaf);
  struct Page {
    std::vector<Change> changes{};
    bool has_more = false;
  };
  /// Returns the changes after `after`, oldest first, at most `limit`, and at most about 4 MiB of
  /// texts.
  Page list(const ChangeFilter& filter, std::int64_t after, std::int64_t limit) const;
  /// All changes of a kind, oldest first; reads no others.
  std::vector<Change> of_kind(std::string_view kind) const;
  /// Visits the hashes of `count` changes after `after`.
  void leaves(std::int64_t after, std::int64_t count,
              const std::function<void(const Digest&)>& visit) const;
};

}  // namespace fitgauge::store

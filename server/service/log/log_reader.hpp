#pragma once

#include "db/store/database.hpp"
#include "db/store/stores.hpp"
#include "service/log/leaves.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/measurement_storage.hpp"

namespace fitgauge::app {

/// Appends a leaf to a tree. @param nodes receives the stored nodes that it completes
void append_leaf(tlog::Frontier& tree, const tlog::Hash& leaf,
                 std::vector<store::LogStore::Node>& nodes);

/// Reads a log in one state of the database: the log of this folder, of its changes, or of a
/// station: records, leaves and nodes. Used inside a read job.
class LogReader {
 public:
  /// Names the changes of this folder, in place of an origin.
  static constexpr std::int64_t kChanges = std::numeric_limits<std::int64_t>::max();

  /// @param origin 0: this folder.
  LogReader(const Stores& stores, RowNames names, std::int64_t origin = 0)
      : stores_(stores), names_(std::move(names)), origin_(origin) {
    if (origin > 0 && origin != kChanges) base_ = stores.origins.base(origin);
  }

  /// The leaves of the rows after `after`, at most `count`.
  std::vector<tlog::Hash> leaves(std::int64_t after, std::int64_t count);

  /// Returns the records of those leaves.
  std::vector<std::string> records(std::int64_t after, std::int64_t count) const;

  /// @pre the subtree is complete and within the size of the stored tree.
  /// @throws store::StorageFailure when a node is not there.
  tlog::Hash node(const tlog::Node& node);

  /// The right edge of the tree of the first `size` leaves. @pre as for node().
  tlog::Frontier frontier(std::uint64_t size);

  /// The bytes of a tile (C2SP tlog-tiles). @pre as for node().
  std::string tile(const tlog::Tile& tile);

 private:
  tlog::Hash root_of(std::vector<tlog::Hash> level);
  std::vector<tlog::Hash> hashes(unsigned tile_level, std::uint64_t first, std::uint64_t count);

  const Stores& stores_;
  const RowNames names_;
  const std::int64_t origin_;
  std::optional<store::OriginsStore::Base> base_{};  ///< a branch begins with rows of another log
  tlog::TreeHasher hasher_;
};

/// The finding for a measurement whose record does not match its leaf.
std::string altered_finding();

/// Rebuilds a log of this folder or of a station from its records in their order, and compares it
/// with stored hashes and signatures.
class LogCheck {
 public:
  /// Returns the stored hash of a node of level 8, 16, …; none if it is absent. Not set: no nodes
  /// are stored.
  using KeptNodes = std::function<std::optional<tlog::Hash>(const tlog::Node&)>;

  LogCheck(LogService::Facts facts, RowNames names, KeptNodes kept)
      : facts_(std::move(facts)),
        names_(std::move(names)),
        kept_(std::move(kept)),
        frontier_(facts_.base) {}

  /// Adds a checkpoint to compare with. @param place its name in findings.
  void expect(const std::string& place, std::string_view note);

  /// The finding for the next measurement of this log, if any.
  std::optional<std::string> add(const MeasurementRow& row);

  /// Adds all changes instead of measurements: each must have its leaf.
  /// @returns whether it could read all of them, and there are some.
  bool add_changes(Database& database);

  /// The finding for the whole log, after the last measurement.
  std::vector<std::string> finish();

  /// Returns size and root of the log, for people, and the checkpoints that do not cover it.
  std::string head_text();

 private:
  struct Expected {
    std::string place;
    tlog::Checkpoint checkpoint;
  };
  void append(const tlog::Hash& leaf, std::int64_t id);
  void compare_nodes(unsigned completed);

  const LogService::Facts facts_;
  const RowNames names_;
  const KeptNodes kept_;
  LeafMaker leaf_;
  std::int64_t partial_rows_ = 0;
  tlog::Frontier frontier_;
  std::multimap<std::uint64_t, Expected> expected_;  ///< by size
  std::vector<std::string> findings_;
  std::vector<std::string> empty_;  ///< checkpoints that cover no leaf
  bool whole_ = true;               ///< no row was missing so far
};

}  // namespace fitgauge::app

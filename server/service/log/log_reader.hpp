#pragma once

#include "db/store/stores.hpp"
#include "service/log/leaf.hpp"
#include "service/measurements/mapping.hpp"

namespace fitgauge::app {

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

}  // namespace fitgauge::app

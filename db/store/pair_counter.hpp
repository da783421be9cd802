#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "db/store/block_columns.hpp"
#include "db/store/pair_statistics.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

/// Counts the current rows of blocks by pairs of their columns, and by more.
class PairCounter {
 public:
  /// Blocks in their order: sums count from the first value.
  void add(const BlockColumns& block);

  /// Calls `visit` for each two columns that have few enough values, and where no more than `most`
  /// statistics come of them, in both orders.
  using Visitor = std::function<void(std::size_t column, std::size_t by_column, PairStatistics)>;
  void visit_pairs(std::size_t most, const Visitor& visit) const;

  /// By the fields that no more than `most` tuples come of. Views what is counted here.
  TupleWriter tuples(std::size_t most) const;

 private:
  void add(const BlockColumns& block, std::size_t column);
  void visit_pair(std::size_t a, std::size_t b, std::size_t most, const Visitor& visit) const;

  std::array<NumberedColumn, kBlockColumns> columns_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::int64_t> measured_nm_;
};

}  // namespace fitgauge::store

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/block_columns.hpp"
#include "store/pair_statistics.hpp"

namespace fitgauge::store {

/// Counts the current rows of blocks by pairs of their columns.
class PairCounter {
 public:
  /// Blocks in their order: sums count from the first value.
  void add(const BlockColumns& block);

  /// Calls `visit` for each two columns that have few enough values, and where no more than `most`
  /// statistics come of them, in both orders.
  using Visitor = std::function<void(std::size_t column, std::size_t by_column, PairStatistics)>;
  void visit_pairs(std::size_t most, const Visitor& visit) const;

 private:
  /// The values of all rows so far, each by a number.
  struct Column {
    bool fits = true;
    std::map<std::optional<std::string>, std::uint16_t> numbers{};
    std::vector<const std::optional<std::string>*> values{};
    std::vector<std::uint16_t> rows{};
  };
  void add(const BlockColumns& block, std::size_t column);
  void visit_pair(std::size_t a, std::size_t b, std::size_t most, const Visitor& visit) const;

  std::array<Column, kBlockColumns> columns_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::int64_t> measured_nm_;
};

}  // namespace fitgauge::store

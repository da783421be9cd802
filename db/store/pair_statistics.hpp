#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/store/block_columns.hpp"
#include "db/store/measurement_statistics.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

/// Statistics of rows by the value of a field, by that of another, which may be none, and by kind
/// (8 * source + verdict).
using PairStatistics =
    std::map<std::string, std::map<std::optional<std::string>, std::map<int, ExactStatistics>>>;

/// How many statistics these are.
std::size_t count_of(const PairStatistics& pairs);

/// As bytes to be stored: of each value of the first field its size, and by that of the other the
/// statistics of each kind.
std::string encode(const PairStatistics& pairs);

/// Calls `visit(by_value, kind, statistics)` for what the bytes of encode() say of a value.
template <class Visit>
void visit_pairs_of(std::string_view bytes, const Visit& visit) {
  PackedNumbers in(bytes);
  while (!in.is_at_end() && in.is_sound()) {
    const std::optional<std::string_view> by_value = in.text();
    for (std::uint64_t kinds = in.number(); kinds > 0 && in.is_sound(); --kinds) {
      const auto kind = static_cast<int>(in.number());
      visit(by_value, kind, ExactStatistics::unpack(in));
    }
  }
}

/// Calls `visit(value, bytes)` for each value of the first field, with what visit_pairs_of() reads,
/// until it returns false.
template <class Visit>
void visit_values(std::string_view bytes, const Visit& visit) {
  PackedNumbers in(bytes);
  while (!in.is_at_end() && in.is_sound()) {
    const std::optional<std::string_view> value = in.text();
    const std::string_view pairs = in.bytes(in.number());
    if (!in.is_sound() || !value || !visit(*value, pairs)) return;
  }
}

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

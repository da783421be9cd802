#pragma once

#include <cstddef>
#include <vector>

#include "base/length.hpp"
#include "base/result.hpp"

namespace fitgauge::metrology {

struct Pair {
  std::size_t hole = 0;  ///< index of what was given, from 0
  std::size_t shaft = 0;
  Length clearance;  ///< hole - shaft

  friend bool operator==(const Pair&, const Pair&) = default;
};

/// Pairs measured holes with measured shafts: as many pairs as there are of the fewer, with the
/// least sum of squares of clearance - target of all assignments. By hole, ascending.
/// Squares are convex, so of two pairs that cross the straight ones are never worse: both sorted,
/// only which of the more are left out is a question, and a table of the differences answers it.
/// @errors StatisticsTooFew without a hole or a shaft; FieldTooLong above kLargestPairing;
///   FiguresLimit where the thread's allowance is spent.
Result<std::vector<Pair>> pair(const std::vector<Length>& holes, const std::vector<Length>& shafts,
                               Length target);

/// The fewer times (one more than the difference): cells of that table.
inline constexpr std::size_t kLargestPairing = 100'000'000;

}  // namespace fitgauge::metrology

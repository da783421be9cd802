#include "metrology/statistics/pairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/allowance.hpp"

namespace fitgauge::metrology {
namespace {

/// Squares of nanometres need more than 64 bits.
__extension__ using Square = __int128;

std::vector<std::size_t> by_size(const std::vector<Length>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  return order;
}

/// For each of the fewer, in order, the one of the more it goes with: fewer[i] with more[i + skip],
/// the skips never falling. Empty where the thread's allowance is spent.
/// @param distance of the i-th of the fewer and the j-th of the more from the target
template <class Distance>
std::vector<std::size_t> assign(std::size_t fewer, std::size_t more, const Distance& distance) {
  const std::size_t skips = more - fewer + 1;
  // best[s]: the least sum of the first i pairs with at most s left out before the last of them.
  std::vector<Square> best(skips, 0);
  std::vector<bool> taken(fewer * skips);  // whether that least sum has exactly s left out
  for (std::size_t i = 0; i < fewer; ++i) {
    if (Allowance::of_thread().is_spent()) return {};
    for (std::size_t s = 0; s < skips; ++s) {
      const Square off = distance(i, i + s).count();
      const Square with = best[s] + off * off;
      const bool take = s == 0 || with < best[s - 1];
      best[s] = take ? with : best[s - 1];
      taken[i * skips + s] = take;
    }
  }
  std::vector<std::size_t> assigned(fewer);
  std::size_t s = skips - 1;
  for (std::size_t i = fewer; i-- > 0;) {
    while (!taken[i * skips + s]) --s;
    assigned[i] = i + s;
  }
  return assigned;
}

}  // namespace

Result<std::vector<Pair>> pair(const std::vector<Length>& holes, const std::vector<Length>& shafts,
                               Length target) {
  if (holes.empty() || shafts.empty()) {
    return Error{ErrorCode::StatisticsTooFew, "pairing takes a hole and a shaft or more"};
  }
  const auto [fewer, more] = std::minmax({holes.size(), shafts.size()});
  if (fewer > kLargestPairing / (more - fewer + 1)) {
    return Error{ErrorCode::FieldTooLong,
                 fmt::format("{} and {} sizes are too many to pair; leave out some of the more, or "
                             "pair them in parts",
                             holes.size(), shafts.size())};
  }
  const std::vector<std::size_t> hole = by_size(holes);
  const std::vector<std::size_t> shaft = by_size(shafts);
  const bool fewer_holes = holes.size() <= shafts.size();
  const auto clearance = [&](std::size_t h, std::size_t s) {
    return holes[hole[h]] - shafts[shaft[s]];
  };
  const auto assigned = assign(fewer, more, [&](std::size_t i, std::size_t j) {
    return (fewer_holes ? clearance(i, j) : clearance(j, i)) - target;
  });
  if (assigned.empty()) {
    return Error{ErrorCode::FiguresLimit, "the pairing takes more time or memory than it may"};
  }
  std::vector<Pair> pairs;
  pairs.reserve(fewer);
  for (std::size_t i = 0; i < fewer; ++i) {
    const std::size_t h = fewer_holes ? i : assigned[i];
    const std::size_t s = fewer_holes ? assigned[i] : i;
    pairs.push_back({hole[h], shaft[s], clearance(h, s)});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.hole < b.hole; });
  return pairs;
}

}  // namespace fitgauge::metrology

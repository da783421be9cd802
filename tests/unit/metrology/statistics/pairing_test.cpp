#include "metrology/statistics/fit_analysis.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace fitgauge;
using namespace fitgauge::metrology;

namespace {

std::vector<Length> lengths(const std::vector<int>& nanometres) {
  std::vector<Length> made;
  for (const int count : nanometres) made.push_back(Length::nanometres(count));
  return made;
}

std::int64_t cost(const std::vector<Pair>& pairs, Length target) {
  std::int64_t sum = 0;
  for (const Pair& pair : pairs) {
    const std::int64_t off = (pair.clearance - target).count();
    sum += off * off;
  }
  return sum;
}

/// The least cost of all assignments, by trying every order of the more.
std::int64_t least_cost(const std::vector<Length>& holes, const std::vector<Length>& shafts,
                        Length target) {
  const bool fewer_holes = holes.size() <= shafts.size();
  const auto& fewer = fewer_holes ? holes : shafts;
  const auto& more = fewer_holes ? shafts : holes;
  std::vector<std::size_t> order(more.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  do {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < fewer.size(); ++i) {
      const Length clearance = fewer_holes ? fewer[i] - more[order[i]] : more[order[i]] - fewer[i];
      const std::int64_t off = (clearance - target).count();
      sum += off * off;
    }
    least = std::min(least, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

}  // namespace

TEST_CASE("pairs are the best of all assignments, whichever are the more") {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    std::vector<int> h(1 + random() % 6);
    std::vector<int> s(1 + random() % 6);
    for (int& x : h) x = static_cast<int>(random() % 12);
    for (int& x : s) x = static_cast<int>(random() % 12);
    const auto holes = lengths(h);
    const auto shafts = lengths(s);
    const Length target = Length::nanometres(static_cast<int>(random() % 7) - 2);
    const auto pairs = pair(holes, shafts, target).value();
    REQUIRE(pairs.size() == std::min(h.size(), s.size()));
    std::vector<bool> hole_used(h.size());
    std::vector<bool> shaft_used(s.size());
    for (const Pair& made : pairs) {
      CHECK_FALSE(hole_used[made.hole]);
      CHECK_FALSE(shaft_used[made.shaft]);
      hole_used[made.hole] = shaft_used[made.shaft] = true;
      CHECK(made.clearance == holes[made.hole] - shafts[made.shaft]);
    }
    CHECK(cost(pairs, target) == least_cost(holes, shafts, target));
  }
}

TEST_CASE("nothing to pair, and too much, is refused") {
  CHECK(pair({}, lengths({1}), Length()).error().code == ErrorCode::StatisticsTooFew);
  CHECK(pair(lengths({1}), {}, Length()).error().code == ErrorCode::StatisticsTooFew);
  const std::vector<Length> many(30'000, Length::nanometres(1));
  const std::vector<Length> fewer(10'000, Length::nanometres(1));
  CHECK(pair(many, fewer, Length()).error().code == ErrorCode::FieldTooLong);
  CHECK(pair(many, many, Length()).value().size() == 30'000);
}

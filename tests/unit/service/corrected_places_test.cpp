#include "service/measurements/measurement_service.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace fitgauge;
using app::CorrectedPlaces;
using app::MovedValue;

namespace {

using Ids = std::vector<std::int64_t>;

/// What corrects what, by id.
using Corrections = std::map<std::int64_t, std::int64_t>;

std::vector<MovedValue> moves_among(const Ids& read, const Corrections& corrections,
                                    std::mt19937_64& random) {
  CorrectedPlaces places;
  std::vector<std::pair<std::int64_t, std::int64_t>> in_any_order(corrections.begin(),
                                                                  corrections.end());
  std::shuffle(in_any_order.begin(), in_any_order.end(), random);
  for (const auto& [id, of] : in_any_order) places.add(id, of);
  places.finish_adding();
  for (const std::int64_t id : read) places.pass(id);
  return places.moves();
}

/// The ids with each move done: what is moved stands before the one it is moved to.
Ids moved(const Ids& read, const std::vector<MovedValue>& moves) {
  std::vector<bool> goes(read.size());
  for (const MovedValue& move : moves) goes[move.from] = true;
  Ids result;
  auto move = moves.begin();
  for (std::size_t i = 0; i < read.size(); ++i) {
    for (; move != moves.end() && move->to == i; ++move) result.push_back(read[move->from]);
    if (!goes[i]) result.push_back(read[i]);
  }
  return result;
}

/// The same by the definition: each id counts as the first of its chain.
Ids by_first_of_chain(Ids read, const Corrections& corrections) {
  const auto first = [&](std::int64_t id) {
    while (corrections.contains(id)) id = corrections.at(id);
    return id;
  };
  std::stable_sort(read.begin(), read.end(),
                   [&](std::int64_t a, std::int64_t b) { return first(a) < first(b); });
  return read;
}

}  // namespace

TEST_CASE("a correction takes the place of the first value of its chain") {
  std::mt19937_64 random(1);
  // 3 corrects 1, 5 corrects 3: of the chain the last is read.
  const Corrections corrections = {{3, 1}, {5, 3}};
  const Ids read = {2, 4, 5, 6};
  const auto moves = moves_among(read, corrections, random);
  REQUIRE(moves.size() == 1);
  CHECK(moves[0].from == 2);
  CHECK(moves[0].to == 0);
  CHECK(moved(read, moves) == Ids{5, 2, 4, 6});
  CHECK(moves_among({1, 2, 4, 6}, {}, random).empty());
}

TEST_CASE("any corrections among any values lie as by the definition") {
  int moving = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto below = [&](std::int64_t end) {
      return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end));
    };
    const std::int64_t last = 1 + below(40);
    const std::int64_t corrected_of_ten = below(10);
    const std::int64_t read_of_ten = 1 + below(10);
    Corrections corrections;
    Ids read;
    for (std::int64_t id = 1; id <= last; ++id) {
      if (id > 1 && below(10) < corrected_of_ten) corrections[id] = 1 + below(id - 1);
      if (below(10) < read_of_ten) read.push_back(id);
    }
    const auto moves = moves_among(read, corrections, random);
    CHECK(moved(read, moves) == by_first_of_chain(read, corrections));
    for (const MovedValue& move : moves) {
      CHECK(move.to <= move.from);
      moving += move.to < move.from ? 1 : 0;
    }
  }
  CHECK(moving > 1000);
}

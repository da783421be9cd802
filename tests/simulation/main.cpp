#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "plant.hpp"
#include "support/deep.hpp"

// plant_simulation [--days N] [--seed N] [--say 1] [--twice 1] [--plant DEFECT] [--folder PATH]: N
// days in runs of 20, each of a seed, one after the other from the first. Ends with 1 at the first
// run that is broken and says its seed, which replays it. --say: a line a run. --twice: each run
// again, which has to be the same. --plant, in plant_simulation_planted: with that defect, 0 when
// it is found.

namespace {

using namespace fitgauge::simulation;

constexpr std::uint64_t kDaysOfARun = 20;

struct Order {
  std::uint64_t days = static_cast<std::uint64_t>(fitgauge::rounds(50, 1000));
  std::uint64_t seed = 1;
  bool says_all = false;
  bool runs_twice = false;
  std::filesystem::path folder =
      std::filesystem::path("/dev/shm") / fmt::format("fitgauge-plant-{}", getpid());
};

std::string_view planted;

std::uint64_t number(const char* text) { return std::strtoull(text, nullptr, 10); }

/// @returns the digest of the run; none: it is broken.
std::optional<std::uint64_t> run(const Order& order, std::uint64_t seed, std::uint64_t days,
                                 Counts& counts) {
  seed_world(seed);
  sqlite3_randomness(0, nullptr);  // it draws anew
  Plant plant(order.folder, seed, counts);
  const std::uint64_t first = counts.days;
  try {
    while (counts.days < first + days) plant.day();
  } catch (const Broken& broken) {
    fmt::print("seed {}, day {}: {}\n{}", seed, counts.days - first + 1, broken.what(),
               plant.story());
    return std::nullopt;
  }
  return digest();
}

}  // namespace

/// Asked by the files that tests/simulation/CMakeLists.txt plants defects in.
bool is_planted(const char* defect);
bool is_planted(const char* defect) { return planted == defect; }

int main(int count, char** arguments) {
  Order order;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string_view name = arguments[i];
    if (name == "--days") order.days = number(arguments[i + 1]);
    if (name == "--seed") order.seed = number(arguments[i + 1]);
    if (name == "--say") order.says_all = true;
    if (name == "--twice") order.runs_twice = true;
    if (name == "--plant") planted = arguments[i + 1];
    if (name == "--folder") order.folder = arguments[i + 1];
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  begin_world();
  Counts counts;
  for (std::uint64_t seed = order.seed; counts.days < order.days; ++seed) {
    const std::uint64_t days = std::min(kDaysOfARun, order.days - counts.days);
    const auto digest = run(order, seed, days, counts);
    if (!digest) return planted.empty() ? 1 : 0;
    if (order.runs_twice) {
      Counts again;
      if (run(order, seed, days, again) != digest) {
        fmt::print("seed {}: the same seed gave another run\n", seed);
        return 1;
      }
    }
    if (order.says_all) fmt::print("seed {}: {} days, {:016x}\n", seed, days, *digest);
  }
  fmt::print(
      "{} days: {} records, {} posts unanswered, {} kills, {} restores that took {} records back, "
      "{} jumps of a clock, {} full disks\n",
      counts.days, counts.acknowledged, counts.repeated, counts.kills, counts.restores,
      counts.taken_back, counts.jumps, counts.full_disks);
  return planted.empty() ? 0 : 1;
}

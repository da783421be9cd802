#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
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

/// Seeds 1 to 18. Seeds 1 to 38 hold.
constexpr int kLongForm = 360;

struct Order {
  std::uint64_t days = static_cast<std::uint64_t>(fitgauge::rounds(50, kLongForm));
  std::uint64_t seed = 1;
  bool says_all = false;
  bool runs_twice = false;
  std::filesystem::path folder =
      std::filesystem::path("/dev/shm") / fmt::format("fitgauge-plant-{}", getpid());
};

std::string_view planted;

std::uint64_t number(const char* text) { return std::strtoull(text, nullptr, 10); }

/// The outcome of a run.
struct Outcome {
  Counts counts{};
  std::uint64_t digest = 0;
  bool is_whole = false;
};

void run(const Order& order, std::uint64_t seed, std::uint64_t days, Outcome& outcome) {
  begin_world();
  seed_world(seed);
  sqlite3_randomness(0, nullptr);  // it draws anew
  Plant plant(order.folder, seed, outcome.counts);
  try {
    while (outcome.counts.days < days) plant.day();
    outcome.digest = digest();
    outcome.is_whole = true;
  } catch (const Broken& broken) {
    fmt::print("seed {}, day {}: {}\n{}", seed, outcome.counts.days + 1, broken.what(),
               plant.story());
  }
}

/// Each run has a process of its own: what was before it changes nothing.
Outcome outcome_of(const Order& order, std::uint64_t seed, std::uint64_t days) {
  void* const shared =
      mmap(nullptr, sizeof(Outcome), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* const outcome = new (shared) Outcome;
  if (fork() == 0) {
    run(order, seed, days, *outcome);
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  wait(&status);
  const Outcome result = *outcome;
  munmap(shared, sizeof(Outcome));
  if (status != 0)
    fmt::print("seed {}, day {}: the process ended with {}\n", seed, result.counts.days + 1,
               status);
  return result;
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
  Counts all;
  for (std::uint64_t seed = order.seed; all.days < order.days; ++seed) {
    const std::uint64_t days = std::min(kDaysOfARun, order.days - all.days);
    const Outcome outcome = outcome_of(order, seed, days);
    if (!outcome.is_whole) return planted.empty() ? 1 : 0;
    if (order.says_all) fmt::print("seed {}: {} days, {:016x}\n", seed, days, outcome.digest);
    if (order.runs_twice && outcome_of(order, seed, days).digest != outcome.digest) {
      fmt::print("seed {}: the same seed gave another run\n", seed);
      return 1;
    }
    all.add(outcome.counts);
  }
  fmt::print(
      "{} days: {} records, {} posts unanswered, {} kills, {} restores that took {} records back, "
      "{} jumps "
      "of a clock, {} full disks\n",
      all.days, all.acknowledged, all.repeated, all.kills, all.restores, all.taken_back, all.jumps,
      all.full_disks);
  return planted.empty() ? 0 : 1;
}

#include <sqlite3.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "plant.hpp"
#include "support/deep.hpp"

// plant_simulation [--days N] [--seed N] [--say 1] [--twice 1] [--plant DEFECT] [--folder PATH]: N
// days in runs of 50, each of a seed, from the first on, on each processor one at a time. Ends with
// 1 at the first run that is broken and says its seed, which replays it. --say: a line a run.
// --twice: each run again, which has to be the same. --plant, in plant_simulation_planted: with
// that defect, 0 when the plant finds it, 1 too when the process just ends.

namespace {

using namespace fitgauge::simulation;

constexpr std::uint64_t kDaysOfARun = 50;

/// Seeds 1 to 20.
constexpr int kLongForm = 1'000;

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
  bool is_broken = false;  ///< the plant found a promise that does not hold
};

void run(const std::filesystem::path& folder, std::uint64_t seed, std::uint64_t days,
         Outcome& outcome) {
  keep_memory_of_sqlite();
  begin_world();
  seed_world(seed);
  sqlite3_randomness(0, nullptr);  // it draws anew
  Plant plant(folder, seed, outcome.counts);
  try {
    while (outcome.counts.days < days) plant.day();
    plant.verify();
    outcome.digest = digest();
    outcome.is_whole = true;
  } catch (const Broken& broken) {
    outcome.is_broken = true;
    fmt::print("seed {}, day {}: {}\n{}", seed, outcome.counts.days + 1, broken.what(),
               plant.story());
  }
}

/// A run that is under way in a process of its own: what was before it changes nothing.
class Running {
 public:
  Running(const Order& order, std::uint64_t seed, std::uint64_t days)
      : seed_(seed), days_(days), folder_(fmt::format("{}-{}", order.folder.string(), seed)) {
    void* const shared =
        mmap(nullptr, sizeof(Outcome), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    outcome_ = new (shared) Outcome;
    process_ = fork();
    if (process_ != 0) return;
    run(folder_, seed, days, *outcome_);
    std::fflush(stdout);
    _exit(0);
  }
  Running& operator=(Running&&) = delete;  // neither copied nor moved
  ~Running() {
    if (process_ > 0) {  // not asked for
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
      std::filesystem::remove_all(folder_);
    }
    munmap(outcome_, sizeof(Outcome));
  }

  std::uint64_t seed() const { return seed_; }
  std::uint64_t days() const { return days_; }

  /// Waits for its end.
  Outcome outcome() {
    int status = 0;
    waitpid(std::exchange(process_, 0), &status, 0);
    if (status != 0)
      fmt::print("seed {}, day {}: the process ended with {}\n", seed_, outcome_->counts.days + 1,
                 status);
    return *outcome_;
  }

 private:
  const std::uint64_t seed_;
  const std::uint64_t days_;
  const std::filesystem::path folder_;
  Outcome* outcome_ = nullptr;
  pid_t process_ = 0;
};

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
  const std::size_t processors = std::max(std::thread::hardware_concurrency(), 1U);
  std::deque<Running> runs;
  std::uint64_t begun = 0;
  while (all.days < order.days) {
    for (; begun < order.days && runs.size() < processors; ++order.seed) {
      const std::uint64_t days = std::min(kDaysOfARun, order.days - begun);
      runs.emplace_back(order, order.seed, days);
      begun += days;
    }
    Running& first = runs.front();
    const Outcome outcome = first.outcome();
    const std::uint64_t seed = first.seed();
    if (!outcome.is_whole) return !planted.empty() && outcome.is_broken ? 0 : 1;
    if (order.says_all)
      fmt::print("seed {}: {} days, {:016x}\n", seed, first.days(), outcome.digest);
    if (order.runs_twice && Running(order, seed, first.days()).outcome().digest != outcome.digest) {
      fmt::print("seed {}: the same seed gave another run\n", seed);
      return 1;
    }
    all.add(outcome.counts);
    runs.pop_front();
  }
  fmt::print(
      "{} days: {} records, {} posts unanswered, {} kills, {} restores that took {} records back, "
      "{} jumps "
      "of a clock, {} full disks\n",
      all.days, all.acknowledged, all.repeated, all.kills, all.restores, all.taken_back, all.jumps,
      all.full_disks);
  return planted.empty() ? 0 : 1;
}

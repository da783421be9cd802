#pragma once

// The world that a simulation runs in: one thread at a time, chosen by the seed; a time that moves
// when every thread waits; disks that fill up and machines that die at a counted write. The product
// is linked as it is: the calls of the C library that it makes are answered in threads.cpp and
// disk.cpp, those of libcurl in network.cpp.

namespace fitgauge::simulation {

inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000 * kMillisecond;

/// A machine of the plant: its clock and its disk. Threads belong to the machine of the thread that
/// started them.
struct Machine {
  std::string name{};
  std::int64_t wall_ns = 0;  ///< what its clock is ahead
  std::int64_t slept_ns = 0;
  bool is_dead = false;             ///< killed: nothing it does reaches its disk or the network
  bool is_full = false;             ///< its disk takes no more
  std::int64_t writes_to_live = 0;  ///< it dies at this write; 0: it does not
  std::uint64_t asked = 0;          ///< how often its centre has answered it what is new
};

/// Makes the calling thread the first one of the world. Call it once, before any other thread.
void begin_world();
/// From here on all is drawn from this seed, and the time begins anew.
void seed_world(std::uint64_t seed);

/// Before anything of SQLite is called.
void keep_memory_of_sqlite();

/// SplitMix64.
struct Random {
  std::uint64_t state;

  std::uint64_t operator()() {
    std::uint64_t mixed = state += 0x9e3779b97f4a7c15ULL;
    mixed = (mixed ^ mixed >> 30U) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ mixed >> 27U) * 0x94d049bb133111ebULL;
    return mixed ^ mixed >> 31U;
  }
};
/// The choices of the scheduler and of the network.
Random& world_random();
/// In [0, below).
std::uint64_t draw(Random& random, std::uint64_t below);

std::int64_t world_now();  ///< running time of the world, ns
void sleep_for(std::int64_t ns);
/// Until somebody rings, at most until then.
void wait_for_ring(const void* bell, std::int64_t until);
void ring(const void* bell);

Machine* current_machine();

/// The thread works on that machine as long as it lives; null: outside of all.
class On {
 public:
  explicit On(Machine* machine);
  ~On();
  On(const On&) = delete;
  On& operator=(const On&) = delete;

 private:
  Machine* const before_;
};

/// The course of the run: the same for the same seed.
void note(std::uint64_t value);
std::uint64_t digest();

}  // namespace fitgauge::simulation

#include <dlfcn.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "world.hpp"

// One thread runs at a time. Where it would wait it gives the turn to another, drawn by the seed
// from those that can go on; when there is none, the time moves to the first that waits for it.

namespace fitgauge::simulation {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kFirstDay = 1'800'000'000 * kSecond;  ///< of the clock on the wall
constexpr std::int64_t kGlance = 1'000;  ///< each reading of the time takes a microsecond
constexpr std::uint64_t kYieldsOneIn = 32;

struct Task {
  Machine* machine = nullptr;
  std::atomic<int> turn{0};
  const void* waits_on = nullptr;
  std::int64_t wake_at = kNever;
  bool is_ready = true;
  bool has_ended = false;
  bool timed_out = false;
  pthread_t thread{};
  void* (*body)(void*) = nullptr;
  void* argument = nullptr;
};

struct World {
  std::vector<Task*> tasks{};  ///< all but ended ones, the oldest first
  std::vector<Task*> ready{};
  std::vector<Task*> ended{};
  std::int64_t now = 0;
  std::int64_t first_wake = 0;  ///< no task that waits has an earlier time
  std::size_t lock_waiters = 0;
  Random random{1};
  std::uint64_t digest = 14695981039346656037ULL;
};

World& world() {
  static World* const the = new World;  // threads may outlive main()
  return *the;
}

thread_local Task* self = nullptr;

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

long call_futex(std::atomic<int>& word, int operation, int value) {
  static auto* const call = real<long(long, ...)>("syscall");
  return call(SYS_futex, &word, operation, value, nullptr, nullptr, 0);
}

void give_turn(Task& to) {
  to.turn.store(1, std::memory_order_release);
  call_futex(to.turn, FUTEX_WAKE_PRIVATE, 1);
}

void await_turn(Task& own) {
  while (own.turn.load(std::memory_order_acquire) == 0) {
    call_futex(own.turn, FUTEX_WAIT_PRIVATE, 0);
  }
  own.turn.store(0, std::memory_order_relaxed);
}

void make_ready(Task& task, bool timed_out) {
  task.is_ready = true;
  task.timed_out = timed_out;
  task.waits_on = nullptr;
  task.wake_at = kNever;
  world().ready.push_back(&task);
}

void wake_those_due() {
  World& w = world();
  if (w.now < w.first_wake) return;
  w.first_wake = kNever;
  for (Task* task : w.tasks) {
    if (!task->is_ready && task->wake_at <= w.now) make_ready(*task, true);
    if (!task->is_ready) w.first_wake = std::min(w.first_wake, task->wake_at);
  }
}

Task& next_task() {
  World& w = world();
  wake_those_due();
  if (w.ready.empty()) {
    std::int64_t first = kNever;
    for (const Task* task : w.tasks) first = std::min(first, task->wake_at);
    if (first == kNever) {
      std::fputs("simulation: every thread waits for another\n", stderr);
      std::abort();
    }
    w.now = w.first_wake = first;
    wake_those_due();
  }
  const std::size_t which = draw(w.random, w.ready.size());
  Task& next = *w.ready[which];
  w.ready.erase(w.ready.begin() + static_cast<std::ptrdiff_t>(which));
  return next;
}

void switch_away() {
  Task& own = *self;
  Task& next = next_task();
  if (&next == &own) return;
  give_turn(next);
  await_turn(own);
}

/// @returns false when the time came first.
bool wait_on(const void* what, std::int64_t until = kNever) {
  Task& own = *self;
  own.is_ready = false;
  own.waits_on = what;
  own.wake_at = until;
  world().first_wake = std::min(world().first_wake, until);
  switch_away();
  return !own.timed_out;
}

int wake(const void* what, int most = INT_MAX) {
  int woken = 0;
  for (Task* task : world().tasks) {
    if (woken == most) break;
    if (task->is_ready || task->waits_on != what) continue;
    make_ready(*task, false);
    ++woken;
  }
  return woken;
}

void yield() {
  world().ready.push_back(self);
  switch_away();
}

template <class Try>
int lock(const void* what, const Try& try_lock) {
  if (draw(world().random, kYieldsOneIn) == 0) yield();
  for (;;) {
    const int got = try_lock();
    if (got != EBUSY) return got;
    ++world().lock_waiters;
    wait_on(what);
    --world().lock_waiters;
  }
}

std::int64_t ns_of(const timespec& time) { return time.tv_sec * kSecond + time.tv_nsec; }

std::int64_t now_on(clockid_t clock) {
  const Machine* const machine = self->machine;
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
      return world().now + kFirstDay + (machine == nullptr ? 0 : machine->wall_ns);
    case CLOCK_BOOTTIME:
      return world().now + kSecond + (machine == nullptr ? 0 : machine->slept_ns);
    default: return world().now + kSecond;
  }
}

int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex, std::int64_t until) {
  pthread_mutex_unlock(mutex);
  const bool is_woken = wait_on(condition, until);
  lock(mutex, [mutex] { return pthread_mutex_trylock(mutex); });
  return is_woken ? 0 : ETIMEDOUT;
}

void* run_task(void* task) {
  Task& own = *static_cast<Task*>(task);
  self = &own;
  await_turn(own);
  void* const result = own.body(own.argument);
  World& w = world();
  own.has_ended = true;
  std::erase(w.tasks, &own);
  wake(&own);
  self = nullptr;  // what its end still destroys has the real calls
  give_turn(next_task());
  return result;
}

}  // namespace

void begin_world() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
  sched_setaffinity(0, sizeof one, &one);  // a turn is given without waking another processor
  auto* const first = new Task;
  first->thread = pthread_self();
  world().tasks.push_back(first);
  self = first;
}

void seed_world(std::uint64_t seed) {
  World& w = world();
  w.random.seed(seed);
  w.digest = 14695981039346656037ULL;
}

Random& world_random() { return world().random; }
std::uint64_t draw(Random& random, std::uint64_t below) { return random() % below; }
std::int64_t world_now() { return world().now; }
void sleep_for(std::int64_t ns) { wait_on(nullptr, world().now + ns); }
Machine* current_machine() { return self == nullptr ? nullptr : self->machine; }

On::On(Machine* machine) : before_(std::exchange(self->machine, machine)) {}
On::~On() { self->machine = before_; }

void note(std::uint64_t value) {
  std::uint64_t& digest = world().digest;
  digest = (digest ^ value) * 1099511628211ULL;
}
std::uint64_t digest() { return world().digest; }

}  // namespace fitgauge::simulation

/// Ids, keys and jitter are drawn by the seed too.
std::random_device::result_type std::random_device::_M_getval() {
  return static_cast<result_type>(fitgauge::simulation::world_random()());
}

using namespace fitgauge::simulation;  // NOLINT: what follows are the calls of the C library

extern "C" {

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                   void* argument) noexcept {
  static auto* const create = real<decltype(pthread_create)>("pthread_create");
  if (self == nullptr) return create(thread, attributes, body, argument);
  auto* const task = new Task;
  task->machine = self->machine;
  task->body = body;
  task->argument = argument;
  const int made = create(&task->thread, attributes, run_task, task);
  if (made != 0) {
    delete task;
    return made;
  }
  *thread = task->thread;
  world().tasks.push_back(task);
  world().ended.push_back(task);
  world().ready.push_back(task);
  return 0;
}

int pthread_join(pthread_t thread, void** result) {
  static auto* const join = real<decltype(pthread_join)>("pthread_join");
  if (self == nullptr) return join(thread, result);
  auto& known = world().ended;
  const auto found = std::find_if(known.begin(), known.end(), [thread](const Task* task) {
    return pthread_equal(task->thread, thread) != 0;
  });
  if (found == known.end()) return ESRCH;
  Task* const task = *found;
  while (!task->has_ended) wait_on(task);
  std::erase(known, task);
  const int joined = join(thread, result);
  delete task;
  return joined;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static auto* const lock_it = real<decltype(pthread_mutex_lock)>("pthread_mutex_lock");
  if (self == nullptr) return lock_it(mutex);
  return lock(mutex, [mutex] { return pthread_mutex_trylock(mutex); });
}

int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  static auto* const unlock = real<decltype(pthread_mutex_unlock)>("pthread_mutex_unlock");
  const int done = unlock(mutex);
  if (self != nullptr && world().lock_waiters > 0) wake(mutex, 1);
  return done;
}

int pthread_rwlock_rdlock(pthread_rwlock_t* rw) noexcept {
  static auto* const lock_it = real<decltype(pthread_rwlock_rdlock)>("pthread_rwlock_rdlock");
  if (self == nullptr) return lock_it(rw);
  return lock(rw, [rw] { return pthread_rwlock_tryrdlock(rw); });
}

int pthread_rwlock_wrlock(pthread_rwlock_t* rw) noexcept {
  static auto* const lock_it = real<decltype(pthread_rwlock_wrlock)>("pthread_rwlock_wrlock");
  if (self == nullptr) return lock_it(rw);
  return lock(rw, [rw] { return pthread_rwlock_trywrlock(rw); });
}

int pthread_rwlock_unlock(pthread_rwlock_t* rw) noexcept {
  static auto* const unlock = real<decltype(pthread_rwlock_unlock)>("pthread_rwlock_unlock");
  const int done = unlock(rw);
  if (self != nullptr && world().lock_waiters > 0) wake(rw);
  return done;
}

int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  return wait_for_condition(condition, mutex, kNever);
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                           const timespec* until) {
  return wait_for_condition(condition, mutex, world().now + ns_of(*until) - now_on(CLOCK_REALTIME));
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
  return wait_for_condition(condition, mutex, world().now + ns_of(*until) - now_on(clock));
}

int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  if (self != nullptr) wake(condition, 1);
  return 0;
}

int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  if (self != nullptr) wake(condition);
  return 0;
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static auto* const get = real<decltype(clock_gettime)>("clock_gettime");
  if (self == nullptr) return get(clock, time);
  world().now += kGlance;
  const std::int64_t now = now_on(clock);
  *time = {.tv_sec = now / kSecond, .tv_nsec = now % kSecond};
  return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec*) {
  const std::int64_t for_ns = flags == 0 ? ns_of(*time) : ns_of(*time) - now_on(clock);
  sleep_for(for_ns);
  return 0;
}

int nanosleep(const timespec* time, timespec*) {
  sleep_for(ns_of(*time));
  return 0;
}

int usleep(useconds_t microseconds) {
  sleep_for(std::int64_t{microseconds} * 1000);
  return 0;
}

int sched_yield() noexcept {
  if (self != nullptr) yield();
  return 0;
}

/// std::atomic::wait and std::future wait by a futex.
long syscall(long number, ...) noexcept {
  static auto* const call = real<long(long, ...)>("syscall");
  va_list list;
  va_start(list, number);
  long a[6];
  for (long& each : a) each = va_arg(list, long);
  va_end(list);
  if (number != SYS_futex || self == nullptr) {
    return call(number, a[0], a[1], a[2], a[3], a[4], a[5]);
  }
  const auto* const word = reinterpret_cast<const int*>(a[0]);
  const int operation = static_cast<int>(a[1]) & FUTEX_CMD_MASK;
  if (operation == FUTEX_WAKE) return wake(word, static_cast<int>(a[2]));
  if (operation != FUTEX_WAIT && operation != FUTEX_WAIT_BITSET) std::abort();
  errno = EAGAIN;
  if (*word != static_cast<int>(a[2])) return -1;
  std::int64_t until = kNever;
  if (const auto* const time = reinterpret_cast<const timespec*>(a[3])) {
    const bool is_real = (static_cast<int>(a[1]) & FUTEX_CLOCK_REALTIME) != 0;
    until = world().now + ns_of(*time);
    if (operation == FUTEX_WAIT_BITSET) until -= now_on(is_real ? CLOCK_REALTIME : CLOCK_MONOTONIC);
  }
  errno = ETIMEDOUT;
  return wait_on(word, until) ? 0 : -1;
}

}  // extern "C"

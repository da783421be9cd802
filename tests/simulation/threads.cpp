#include <dlfcn.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sys/single_threaded.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <random>

#include "place.hpp"
#include "world.hpp"

// One thread runs at a time. Where it would wait it gives the turn to another, drawn by the seed
// from those that can go on; when there is none, the time moves to the first that waits for it.
// All are of one thread of the kernel: see place.hpp.

namespace fitgauge::simulation {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kFirstDay = 1'800'000'000 * kSecond;  ///< of the clock on the wall
constexpr std::int64_t kGlance = 1'000;  ///< each reading of the time takes a microsecond
constexpr std::uint64_t kYieldsOneIn = 32;
constexpr int kUnderWay = 1;  ///< of a pthread_once_t, as glibc has it
constexpr int kDone = 2;

struct Task : Place {
  Machine* machine = nullptr;
  const void* waits_on = nullptr;
  std::int64_t wake_at = kNever;
  bool is_ready = true;
  bool has_ended = false;
  bool timed_out = false;
  pthread_t thread{};
  int number = 0;  ///< of no other
  void* (*body)(void*) = nullptr;
  void* argument = nullptr;
  void* result = nullptr;
  std::vector<std::pair<void (*)(void*), void*>> at_exit{};
};

struct World {
  std::vector<Task*> tasks{};  ///< all but ended ones, the oldest first
  std::vector<Task*> ready{};
  std::vector<Task*> to_join{};
  std::int64_t now = 0;
  std::int64_t first_wake = 0;  ///< no task that waits has an earlier time
  std::size_t lock_waiters = 0;
  int created = 0;
  Random random{1};
  std::uint64_t digest = 14695981039346656037ULL;
};

World& world() {
  static World* const the = new World;  // threads may outlive main()
  return *the;
}

Task* self = nullptr;

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
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
  note(static_cast<std::uint64_t>(next.number));
  note(static_cast<std::uint64_t>(w.now));
  return next;
}

void switch_away() {
  Task& own = *self;
  Task& next = next_task();
  if (&next == &own) return;
  self = &next;
  go(own, next);
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

void run_task() noexcept {
  Task& own = *self;
  own.result = own.body(own.argument);
  for (auto& at_exit = own.at_exit; !at_exit.empty();) {
    const auto [destroy, what] = at_exit.back();
    at_exit.pop_back();
    destroy(what);
  }
  World& w = world();
  own.has_ended = true;
  std::erase(w.tasks, &own);
  wake(&own);
  Task& next = next_task();
  self = &next;
  go_for_ever(own, next);
}

bool is_recursive(const pthread_mutex_t& mutex) {
  return (mutex.__data.__kind & 3) == PTHREAD_MUTEX_RECURSIVE_NP;
}

/// The threads are one to the kernel, so who has a mutex is kept here, in its own fields.
int try_lock(pthread_mutex_t& mutex) {
  auto& state = mutex.__data;
  if (state.__lock == 0) {
    state.__lock = 1;
    state.__owner = self->number;
  } else if (!is_recursive(mutex) || state.__owner != self->number) {
    return EBUSY;
  }
  ++state.__count;
  return 0;
}

int unlock(pthread_mutex_t& mutex) {
  auto& state = mutex.__data;
  if (--state.__count > 0) return 0;
  state.__lock = 0;
  state.__owner = 0;
  if (world().lock_waiters > 0) wake(&mutex, 1);
  return 0;
}

int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex, std::int64_t until) {
  pthread_mutex_unlock(mutex);
  const bool is_woken = wait_on(condition, until);
  lock(mutex, [mutex] { return try_lock(*mutex); });
  return is_woken ? 0 : ETIMEDOUT;
}

}  // namespace

void begin_world() {
  __libc_single_threaded = 0;  // the library of C++ leaves out what only threads need
  auto* const first = new Task;
  first->thread = pthread_self();
  world().tasks.push_back(first);
  self = first;
}

void seed_world(std::uint64_t seed) {
  World& w = world();
  w.random = {seed};
  w.digest = 14695981039346656037ULL;
}

Random& world_random() { return world().random; }
std::uint64_t draw(Random& random, std::uint64_t below) { return random() % below; }
std::int64_t world_now() { return world().now; }
void sleep_for(std::int64_t ns) { wait_on(nullptr, world().now + ns); }
void wait_for_ring(const void* bell, std::int64_t until) { wait_on(bell, until); }
void ring(const void* bell) { wake(bell); }
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
  task->number = ++world().created;
  task->body = body;
  task->argument = argument;
  begin_at(*task, run_task);
  *thread = task->thread = reinterpret_cast<pthread_t>(task);
  world().tasks.push_back(task);
  world().to_join.push_back(task);
  world().ready.push_back(task);
  return 0;
}

int pthread_join(pthread_t thread, void** result) {
  static auto* const join = real<decltype(pthread_join)>("pthread_join");
  if (self == nullptr) return join(thread, result);
  auto& known = world().to_join;
  const auto found = std::find_if(known.begin(), known.end(), [thread](const Task* task) {
    return pthread_equal(task->thread, thread) != 0;
  });
  if (found == known.end()) return ESRCH;
  Task* const task = *found;
  while (!task->has_ended) wait_on(task);
  std::erase(known, task);
  if (result != nullptr) *result = task->result;
  delete task;
  return 0;
}

pthread_t pthread_self() noexcept {
  static auto* const get = real<decltype(pthread_self)>("pthread_self");
  return self == nullptr ? get() : self->thread;
}

/// Names are for the kernel, which knows only one of the threads.
int pthread_setname_np(pthread_t, const char*) noexcept { return 0; }

int __cxa_thread_atexit(void (*destroy)(void*), void* what, void*) noexcept {
  if (self != nullptr) self->at_exit.emplace_back(destroy, what);
  return 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static auto* const lock_it = real<decltype(pthread_mutex_lock)>("pthread_mutex_lock");
  if (self == nullptr) return lock_it(mutex);
  return lock(mutex, [mutex] { return try_lock(*mutex); });
}

int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  static auto* const try_it = real<decltype(pthread_mutex_trylock)>("pthread_mutex_trylock");
  return self == nullptr ? try_it(mutex) : try_lock(*mutex);
}

int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  static auto* const unlock_it = real<decltype(pthread_mutex_unlock)>("pthread_mutex_unlock");
  return self == nullptr ? unlock_it(mutex) : unlock(*mutex);
}

/// Each promise of std is kept through it, with a call of the kernel for those who may wait.
int pthread_once(pthread_once_t* once, void (*begin)()) {
  static auto* const real_once = real<decltype(pthread_once)>("pthread_once");
  if (self == nullptr) return real_once(once, begin);
  while (*once == kUnderWay) wait_on(once);
  if (*once == kDone) return 0;
  *once = kUnderWay;
  const auto end = [once](int state) {
    *once = state;
    wake(once);
  };
  try {
    begin();
  } catch (...) {
    end(PTHREAD_ONCE_INIT);
    throw;
  }
  end(kDone);
  return 0;
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

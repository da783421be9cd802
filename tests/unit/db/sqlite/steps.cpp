#include "steps.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>

namespace fitgauge::store::test {
namespace {

std::atomic<int> made = 0;
std::atomic<int> last = 0;  // 0: none

/// The library's own function.
template <class Function>
Function* next(const char* name, Function* /*its type*/) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void count_step() {
  if (++made == last) ::kill(::getpid(), SIGKILL);
}

}  // namespace

void kill_at(int step) { last = made + step; }

int steps_made() { return made; }

}  // namespace fitgauge::store::test

// The linker takes these before the libraries', also for SQLite.
#define FITGAUGE_STEP(result, name, parameters, arguments, ...)               \
  extern "C" result name parameters __VA_ARGS__ {                             \
    static const auto the_next = fitgauge::store::test::next(#name, &::name); \
    fitgauge::store::test::count_step();                                      \
    return the_next arguments;                                                \
  }

FITGAUGE_STEP(ssize_t, write, (int file, const void* bytes, size_t size), (file, bytes, size))
FITGAUGE_STEP(ssize_t, pwrite64, (int file, const void* bytes, size_t size, off64_t at),
              (file, bytes, size, at))
FITGAUGE_STEP(int, ftruncate64, (int file, off64_t size), (file, size), noexcept)
FITGAUGE_STEP(int, fsync, (int file), (file))
FITGAUGE_STEP(int, fdatasync, (int file), (file))
FITGAUGE_STEP(int, unlink, (const char* path), (path), noexcept)
FITGAUGE_STEP(int, rename, (const char* from, const char* to), (from, to), noexcept)
FITGAUGE_STEP(int, renameat2,
              (int from_folder, const char* from, int to_folder, const char* to, unsigned flags),
              (from_folder, from, to_folder, to, flags), noexcept)

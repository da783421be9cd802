#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

#include "world.hpp"

// Calls that change a disk: each counts, and none of a dead machine does anything.

namespace {

using fitgauge::simulation::current_machine;
using fitgauge::simulation::Machine;

/// @param grows it needs room
bool may_change(bool grows) {
  Machine* const machine = current_machine();
  if (machine == nullptr) return true;
  if (machine->writes_to_live > 0 && --machine->writes_to_live == 0) machine->is_dead = true;
  if (!machine->is_dead && !(grows && machine->is_full)) return true;
  errno = machine->is_dead ? EIO : ENOSPC;
  return false;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// The random bytes that SQLite begins with.
int open_random() {
  const int file = memfd_create("random", MFD_CLOEXEC);
  for (int i = 0; i < 64; ++i) {
    const auto value = fitgauge::simulation::world_random()();
    static_cast<void>(!::write(file, &value, sizeof value));
  }
  lseek(file, 0, SEEK_SET);
  return file;
}

}  // namespace

extern "C" {

int open64(const char* name, int flags, ...) {
  static auto* const call = next<int(const char*, int, ...)>("open64");
  va_list list;
  va_start(list, flags);
  const unsigned mode = va_arg(list, unsigned);
  va_end(list);
  if (current_machine() != nullptr && std::string_view(name) == "/dev/urandom")
    return open_random();
  return call(name, flags, mode);
}

/// The locks of SQLite: a process has nobody to lock them against but others, which there are not.
int fcntl64(int file, int command, ...) {
  static auto* const call = next<int(int, int, ...)>("fcntl64");
  va_list list;
  va_start(list, command);
  void* const argument = va_arg(list, void*);
  va_end(list);
  return command == F_SETLK && current_machine() != nullptr ? 0 : call(file, command, argument);
}

ssize_t write(int file, const void* bytes, size_t size) {
  static auto* const call = next<decltype(write)>("write");
  if (file > 2 && !may_change(true)) return -1;
  return call(file, bytes, size);
}

/// The last write of a machine that dies may have come half through.
ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
  static auto* const call = next<decltype(pwrite64)>("pwrite64");
  const Machine* const machine = current_machine();
  const bool was_dead = machine != nullptr && machine->is_dead;
  if (may_change(true)) return call(file, bytes, size, offset);
  const int why = errno;
  if (!was_dead && why == EIO && size % 8 == 0)
    static_cast<void>(call(file, bytes, size / 2, offset));
  errno = why;
  return -1;
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  return pwrite64(file, bytes, size, offset);
}

int fsync(int file) {
  static auto* const call = next<decltype(fsync)>("fsync");
  return may_change(false) ? call(file) : -1;
}
int fdatasync(int file) {
  static auto* const call = next<decltype(fdatasync)>("fdatasync");
  return may_change(false) ? call(file) : -1;
}
int ftruncate64(int file, off64_t size) noexcept {
  static auto* const call = next<decltype(ftruncate64)>("ftruncate64");
  return may_change(false) ? call(file, size) : -1;
}
int ftruncate(int file, off_t size) noexcept { return ftruncate64(file, size); }

int rename(const char* from, const char* to) noexcept {
  static auto* const call = next<decltype(rename)>("rename");
  return may_change(false) ? call(from, to) : -1;
}
int renameat2(int in, const char* from, int out, const char* to, unsigned flags) noexcept {
  static auto* const call = next<decltype(renameat2)>("renameat2");
  return may_change(false) ? call(in, from, out, to, flags) : -1;
}
int unlink(const char* name) noexcept {
  static auto* const call = next<decltype(unlink)>("unlink");
  return may_change(false) ? call(name) : -1;
}

}  // extern "C"

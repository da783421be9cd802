#include "place.hpp"

#include <link.h>
#include <sys/mman.h>

#include <cerrno>

namespace fitgauge::simulation {
namespace {

constexpr std::size_t kStack = std::size_t{1} << 20;
constexpr std::size_t kPage = 4096;

/// The variables of a thread in this program and in the library of C++.
struct Locals {
  char* begin;
  const char* first_values;
  std::size_t has_values;
  std::size_t size;
};

int add_locals(dl_phdr_info* module, std::size_t, void* all) {
  const std::string_view name = module->dlpi_name;
  if (!name.empty() && name.find("libstdc++") == name.npos) return 0;
  for (int i = 0; i < module->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = module->dlpi_phdr[i];
    if (part.p_type != PT_TLS) continue;
    static_cast<std::vector<Locals>*>(all)->push_back(
        {.begin = static_cast<char*>(module->dlpi_tls_data),
         .first_values = reinterpret_cast<const char*>(module->dlpi_addr + part.p_vaddr),
         .has_values = part.p_filesz,
         .size = part.p_memsz});
  }
  return 0;
}

const std::vector<Locals>& all_locals() {
  static const std::vector<Locals> all = [] {
    std::vector<Locals> found;
    dl_iterate_phdr(add_locals, &found);
    return found;
  }();
  return all;
}

void keep_locals(Place& place) {
  place.error = errno;
  place.locals.clear();
  for (const Locals& each : all_locals())
    place.locals.insert(place.locals.end(), each.begin, each.begin + each.size);
}

void put_locals(const Place& place) {
  const char* values = place.locals.data();
  for (const Locals& each : all_locals()) {
    std::memcpy(each.begin, values, each.size);
    values += each.size;
  }
  errno = place.error;
}

/// Without a call of the kernel, other than setcontext().
[[noreturn]] void come_to(Place& place) {
  put_locals(place);
  if (place.has_left) _longjmp(place.left_at, 1);
  setcontext(&place.context);
  std::abort();
}

std::vector<void*>& free_stacks() {
  static auto* const stacks = new std::vector<void*>;
  return *stacks;
}

void* take_stack() {
  std::vector<void*>& stacks = free_stacks();
  if (!stacks.empty()) {
    void* const stack = stacks.back();
    stacks.pop_back();
    return stack;
  }
  void* const made = mmap(nullptr, kStack, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (made == MAP_FAILED) std::abort();
  mprotect(made, kPage, PROT_NONE);  // past its end
  return made;
}

}  // namespace

void begin_at(Place& place, void (*call)()) {
  for (const Locals& each : all_locals()) {
    const std::size_t begin = place.locals.size();
    place.locals.insert(place.locals.end(), each.first_values, each.first_values + each.has_values);
    place.locals.resize(begin + each.size);
  }
  place.stack = take_stack();
  getcontext(&place.context);
  place.context.uc_stack.ss_sp = place.stack;
  place.context.uc_stack.ss_size = kStack;
  makecontext(&place.context, call, 0);
}

void go(Place& from, Place& to) {
  keep_locals(from);
  from.has_left = true;
  if (_setjmp(from.left_at) == 0) come_to(to);
}

void go_for_ever(Place& from, Place& to) {
  free_stacks().push_back(from.stack);  // nobody takes it before this one has left it
  come_to(to);
}

}  // namespace fitgauge::simulation

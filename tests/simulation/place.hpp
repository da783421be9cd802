#pragma once

#include <setjmp.h>
#include <ucontext.h>

namespace fitgauge::simulation {

/// Where a thread of the world is while another runs. All are of one thread of the kernel, which
/// goes from stack to stack and takes the variables of a thread along.
struct Place {
  ucontext_t context{};  ///< of its beginning
  jmp_buf left_at{};
  bool has_left = false;
  void* stack = nullptr;
  std::vector<char> locals{};
  int error = 0;
};

/// It begins with a call that does not return, on a stack of its own.
void begin_at(Place& place, void (*call)());
void go(Place& from, Place& to);
/// Nobody comes back: its stack is free.
[[noreturn]] void go_for_ever(Place& from, Place& to);

}  // namespace fitgauge::simulation

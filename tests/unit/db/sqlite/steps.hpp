#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include <csignal>

namespace fitgauge::store::test {

/// A step is a system call that changes a file or a folder: a write, a flush, a new name. The
/// executable defines these calls itself (steps.cpp) and counts them, in any thread.

/// Sends this process SIGKILL at the beginning of its `step`-th step from now, the first is 1.
void kill_at(int step);

/// How many steps `work` makes, in this process.
int steps_made();

/// Runs `work` in a process of its own; returns whether SIGKILL ended it. What `work` throws ends
/// the process too.
template <class Work>
bool is_killed(Work work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    try {
      work();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

}  // namespace fitgauge::store::test

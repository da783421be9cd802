#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stop_token>

namespace fitgauge {

/// Bytes that the calling thread has taken with `new` less those it has given back, since it
/// began. The program's operators new and delete keep this count, so no container can be
/// forgotten, and what the allocator keeps beside each piece is counted with it. Memory that
/// another thread gives back is counted there.
std::int64_t thread_memory();

/// Adds to the calling thread's count: `bytes` that another thread has taken and this one is to
/// give back, or, negative, the other way round.
void hand_over_memory(std::int64_t bytes);

/// The budget of one piece of work: time of the wall clock, memory of its thread, and whether
/// it has been called off. Every loop whose length a user chooses looks at it and leaves off once
/// it is spent; spent stays spent, so a result computed meanwhile can be told from a whole one.
/// Belongs to the thread that makes it; the stop may be requested by any.
class Allowance {
 public:
  enum class Spent : std::uint8_t { Nothing, Stop, Time, Memory };

  /// Unlimited.
  Allowance() = default;
  /// From now on.
  Allowance(std::chrono::duration<double> time, std::size_t memory_bytes, std::stop_token stop);
  Allowance& operator=(Allowance&&) = delete;  // neither copied nor moved

  /// Looks at clock, memory and stop: about 50 ns.
  Spent look();
  bool is_spent() { return look() != Spent::Nothing; }

  /// While it lives, loops of the calling thread find an allowance by of_thread().
  class OfThread {
   public:
    /// @param allowance null: none; outlives this.
    explicit OfThread(Allowance* allowance);
    OfThread& operator=(OfThread&&) = delete;  // neither copied nor moved
    ~OfThread();
  };
  /// That of the calling thread's work; an unlimited one where it has none.
  static Allowance& of_thread();
  /// The result of an earlier check.
  Spent found() const { return spent_; }

  /// Counts memory that this work keeps alive but has not taken itself: a shared program.
  void share(std::size_t bytes) { baseline_ -= static_cast<std::int64_t>(bytes); }
  /// Runs `take` without counting what it takes: for caches that outlive the work.
  template <class Take>
  auto uncounted(const Take& take) {
    const std::int64_t before = thread_memory();
    auto taken = take();
    baseline_ += thread_memory() - before;
    return taken;
  }

 private:
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  std::int64_t memory_bytes_ = std::numeric_limits<std::int64_t>::max() / 2;
  std::stop_token stop_;
  std::int64_t baseline_ = 0;
  Spent spent_ = Spent::Nothing;
};

}  // namespace fitgauge

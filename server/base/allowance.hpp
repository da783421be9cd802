#pragma once

namespace fitgauge {

/// Bytes that the calling thread has allocated minus the bytes it has freed since it began. The
/// program's operators new and delete count them, with the overhead of the allocator. Memory that
/// another thread frees is counted there.
std::int64_t thread_memory();

/// Adds `bytes` to the count of the calling thread, for memory that another thread allocates or
/// frees.
void hand_over_memory(std::int64_t bytes);

/// Budget of one piece of work: wall-clock time, memory of its thread, and a stop request. Every
/// loop whose length a user chooses checks it and ends if it is spent. A spent budget stays spent,
/// so an incomplete result can be recognised. Belongs to one thread; any may request the stop.
class Allowance {
 public:
  enum class Spent : std::uint8_t { Nothing, Stop, Time, Memory };

  /// Unlimited.
  Allowance() = default;
  /// Begins now.
  Allowance(std::chrono::duration<double> time, std::size_t memory_bytes, std::stop_token stop);
  Allowance& operator=(Allowance&&) = delete;  // neither copied nor moved

  /// Looks at clock, memory and stop: about 50 ns.
  Spent look();
  bool is_spent() { return look() != Spent::Nothing; }

  /// Spends it at that look from now, whatever the clock says: the same work ends at the same step.
  void spend_at_look(std::uint64_t count, Spent found) { looks_ = count, at_look_ = found; }

  /// Lets loops of the calling thread find an allowance by of_thread() while it lives.
  class OfThread {
   public:
    /// @param allowance null: none; outlives this.
    explicit OfThread(Allowance* allowance);
    OfThread& operator=(OfThread&&) = delete;  // neither copied nor moved
    ~OfThread();
  };
  /// Returns the allowance of the calling thread's work; an unlimited one if it has none.
  static Allowance& of_thread();
  /// The result of an earlier check.
  Spent found() const { return spent_; }

  /// Counts memory that this work keeps alive but did not allocate, such as a shared program.
  void share(std::size_t bytes) { baseline_ -= static_cast<std::int64_t>(bytes); }
  /// Runs `take` without counting its memory: for caches that outlive the work.
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
  Spent at_look_ = Spent::Nothing;
  std::uint64_t looks_ = 0;  ///< until at_look_; 0: none
};

}  // namespace fitgauge

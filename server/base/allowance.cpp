#include "base/allowance.hpp"

#include <utility>

namespace fitgauge {
namespace {

thread_local Allowance* current = nullptr;

}  // namespace

Allowance::Allowance(std::chrono::duration<double> time, std::size_t memory_bytes,
                     std::stop_token stop)
    : deadline_(std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(time)),
      memory_bytes_(static_cast<std::int64_t>(memory_bytes)),
      stop_(std::move(stop)),
      baseline_(thread_memory()) {}

Allowance::Spent Allowance::look() {
  if (spent_ != Spent::Nothing) return spent_;
  if (stop_.stop_requested()) {
    spent_ = Spent::Stop;
  } else if (thread_memory() - baseline_ > memory_bytes_) {
    spent_ = Spent::Memory;
  } else if (std::chrono::steady_clock::now() > deadline_) {
    spent_ = Spent::Time;
  }
  return spent_;
}

Allowance::OfThread::OfThread(Allowance* allowance) { current = allowance; }
Allowance::OfThread::~OfThread() { current = nullptr; }

Allowance& Allowance::of_thread() {
  thread_local Allowance unlimited;
  return current != nullptr ? *current : unlimited;
}

}  // namespace fitgauge

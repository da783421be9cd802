#include "base/worker_pool.hpp"

#include <malloc.h>

namespace fitgauge {

WorkerPool::WorkerPool(std::string_view place, unsigned threads, std::size_t queue)
    : place_(place), queue_(queue) {
  for (unsigned i = 0; i < threads; ++i)
    threads_.emplace_back(place, [this](const auto&) { run(); });
}

WorkerPool::~WorkerPool() { stop(); }

std::optional<WorkerPool::Ticket> WorkerPool::submit(Job job) {
  const Ticket ticket = ++last_ticket_;
  if (queue_.push({ticket, std::move(job)})) return std::nullopt;
  return ticket;
}

bool WorkerPool::withdraw(Ticket ticket) {
  return queue_.withdraw([ticket](const Queued& each) { return each.ticket == ticket; })
      .has_value();
}

void WorkerPool::stop() {
  queue_.close();
  for (Thread& thread : threads_) thread.stop();
  threads_.clear();
}

/// After a long job the free memory between the blocks of others goes back to the kernel.
void WorkerPool::run() {
  constexpr std::chrono::milliseconds kLong{100};
  while (auto taken = queue_.take_one()) {
    const auto begin = std::chrono::steady_clock::now();
    guarded(place_, taken->job);
    taken.reset();
    if (std::chrono::steady_clock::now() - begin > kLong) malloc_trim(0);
  }
}

Error JobPool::full() {
  return {ErrorCode::Overloaded, "too much work of this kind is waiting: try again soon"};
}

Error JobPool::internal(const std::exception& bug) {
  return {ErrorCode::Internal, std::string("a request failed: ") + bug.what()};
}

Error JobPool::beyond_bound(Allowance::Spent spent) {
  if (spent == Allowance::Spent::Stop) return shutting_down();
  const std::string_view what = spent == Allowance::Spent::Time ? "time" : "memory";
  return {ErrorCode::FiguresLimit,
          "the figure needs more " + std::string(what) +
              " than one request may use: use fewer values or fewer trials"};
}

}  // namespace fitgauge

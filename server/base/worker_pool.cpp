#include "base/worker_pool.hpp"

#include <utility>

#include "base/guarded.hpp"

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

void WorkerPool::run() {
  while (const auto taken = queue_.take_one()) guarded(place_, taken->job);
}

}  // namespace fitgauge

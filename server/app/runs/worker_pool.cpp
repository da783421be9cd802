#include "app/runs/worker_pool.hpp"

#include <algorithm>
#include <utility>

#include "base/guarded.hpp"

namespace fitgauge::app {

WorkerPool::WorkerPool(unsigned threads, std::size_t queue) : capacity_(queue) {
  for (unsigned i = 0; i < threads; ++i)
    threads_.emplace_back("a worker", [this](const auto&) { run(); });
}

WorkerPool::~WorkerPool() { stop(); }

std::optional<WorkerPool::Ticket> WorkerPool::submit(Job job) {
  Ticket ticket = 0;
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || jobs_.size() >= capacity_) return std::nullopt;
    ticket = next_ticket_++;
    jobs_.push_back({ticket, std::move(job)});
  }
  changed_.notify_one();
  return ticket;
}

bool WorkerPool::withdraw(Ticket ticket) {
  Job withdrawn;  // destroyed outside the lock
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(jobs_.begin(), jobs_.end(),
                                  [ticket](const Queued& each) { return each.ticket == ticket; });
  if (found == jobs_.end()) return false;
  withdrawn = std::move(found->job);
  jobs_.erase(found);
  return true;
}

void WorkerPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (Thread& thread : threads_) thread.stop();
  threads_.clear();
}

void WorkerPool::run() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const Job job = std::move(jobs_.front().job);
    jobs_.pop_front();
    lock.unlock();
    guarded("a worker's job", job);
  }
}

}  // namespace fitgauge::app

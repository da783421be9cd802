#pragma once

#include <memory>
#include <utility>

#include "base/bounded_queue.hpp"
#include "base/error.hpp"

namespace fitgauge::store {

template <class Job>
using JobQueue = BoundedQueue<std::unique_ptr<Job>>;

/// Queues a job, or refuses it on this thread when it finds no place.
template <class Job>
void enqueue_or_refuse(JobQueue<Job>& queue, std::unique_ptr<Job> job) {
  using Refusal = typename JobQueue<Job>::Refusal;
  const auto refusal = queue.push(std::move(job));
  if (refusal == Refusal::Closed)
    job->refuse({ErrorCode::ShuttingDown, "the service is shutting down"});
  if (refusal == Refusal::Full)
    job->refuse({ErrorCode::StorageBusy, "the storage has all the work it takes; try again soon"});
}

}  // namespace fitgauge::store

#pragma once

#include <memory>
#include <vector>

#include "base/thread.hpp"
#include "db/sql/session.hpp"
#include "db/store/jobs.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// The reader threads with their connections. Destroying it runs what is queued.
class ReadPool::Engine {
 public:
  using ReadJob = Job<const Stores>;

  Engine(const OpenOptions& options, HealthMonitor& health, sql::OpenSession open);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  void enqueue(std::unique_ptr<ReadJob> job) { enqueue_or_refuse(queue_, std::move(job)); }

  std::size_t queued() const { return queue_.size(); }

  /// Runs what is queued and ends the threads; what comes later is refused.
  void stop();

 private:
  void run();
  void read(std::unique_ptr<sql::Session>& session, ReadJob& job);

  const OpenOptions options_;
  HealthMonitor& health_;
  const sql::OpenSession open_;
  JobQueue<ReadJob> queue_;
  std::vector<Thread> threads_;
};

}  // namespace fitgauge::store

#include "db/sql/read_pool_engine.hpp"

#include <exception>
#include <optional>

#include "db/store/stores.hpp"

namespace fitgauge::store {

ReadPool::Engine::Engine(const OpenOptions& options, HealthMonitor& health, sql::OpenSession open)
    : options_(options), health_(health), open_(std::move(open)), queue_(options.queue_limit) {
  for (unsigned i = 0; i < options.readers; ++i)
    threads_.emplace_back("a store reader", [this](const auto&) { run(); });
}

ReadPool::Engine::~Engine() { stop(); }

void ReadPool::Engine::stop() {
  queue_.close();
  for (Thread& thread : threads_) thread.stop();
  threads_.clear();
}

void ReadPool::Engine::run() {
  std::unique_ptr<sql::Session> session;
  while (const auto taken = queue_.take_one()) {
    ReadJob& job = **taken;
    std::optional<Error> error;
    try {
      read(session, job);
    } catch (const StorageFailure& failure) {
      error = failure.error();
    } catch (const std::exception& bug) {
      error = Error{ErrorCode::Internal, std::string("a storage job failed: ") + bug.what()};
      if (options_.job_threw) options_.job_threw(*error);
    }
    if (error) {
      session.reset();
      if (error->code == ErrorCode::StorageCorrupt) health_.damaged(error->message);
    }
    tell(job, std::move(error));
  }
}

/// In a transaction, so that all statements of the job see the same state.
void ReadPool::Engine::read(std::unique_ptr<sql::Session>& session, ReadJob& job) {
  if (!session) session = open_();
  job.prepare();
  session->begin_reading();
  job.run(session->stores());
  session->commit();
}

void ReadPool::enqueue(std::unique_ptr<Job<const Stores>> job) { engine_.enqueue(std::move(job)); }

}  // namespace fitgauge::store

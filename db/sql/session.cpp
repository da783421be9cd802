#include "db/sql/session.hpp"

namespace fitgauge::store {

template <class Change>
void HealthMonitor::change(Change change) {
  const std::lock_guard lock(mutex_);
  const HealthState before = current().state;
  const bool was_set_back = !set_back_.empty();
  change();
  const Health after = current();
  const bool is_news = after.state != before || was_set_back == set_back_.empty();
  if (is_news && report_) report_(after);
}

void HealthMonitor::checking(std::string reason) {
  change([&] { checking_ = std::move(reason); });
}

void HealthMonitor::check_passed() {
  change([&] { checking_.clear(); });
}

void HealthMonitor::damaged(std::string reason) {
  change([&] {
    if (damage_.empty()) damage_ = std::move(reason);
  });
}

void HealthMonitor::set_back(std::string reason) {
  change([&] { set_back_ = std::move(reason); });
}

void HealthMonitor::writes_failed(std::string reason) {
  change([&] { write_failure_ = std::move(reason); });
}

void HealthMonitor::writes_succeeded() {
  change([&] { write_failure_.clear(); });
}

void HealthMonitor::server_is_away(bool is_away) {
  change([&] { server_is_away_ = is_away; });
}

Health HealthMonitor::health() const {
  const std::lock_guard lock(mutex_);
  return current();
}

Health HealthMonitor::current() const {
  if (!set_back_.empty()) return {HealthState::WritesFailing, set_back_};
  if (!damage_.empty()) return {HealthState::Damaged, damage_};
  if (!write_failure_.empty()) return {HealthState::WritesFailing, write_failure_};
  if (server_is_away_) return {HealthState::WritesFailing, "PostgreSQL does not answer"};
  if (!checking_.empty()) return {HealthState::Checking, checking_};
  return {};
}

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

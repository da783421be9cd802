#include "db/sql/session.hpp"

namespace fitgauge::store {

void HealthMonitor::note(Finding finding, std::string reason) {
  const std::lock_guard lock(mutex_);
  const HealthState before = current().state;
  const bool was_set_back = !reasons_.front().empty();
  std::string& kept = reasons_.at(static_cast<std::size_t>(finding));
  if (finding != Finding::Damage || kept.empty()) kept = std::move(reason);
  const Health after = current();
  const bool is_news = after.state != before || was_set_back == reasons_.front().empty();
  if (is_news && report_) report_(after);
}

Health HealthMonitor::health() const {
  const std::lock_guard lock(mutex_);
  return current();
}

Health HealthMonitor::current() const {
  using State = HealthState;
  constexpr State kStates[] = {State::WritesFailing, State::Damaged, State::WritesFailing,
                               State::WritesFailing, State::Checking};
  const auto found = std::ranges::find_if_not(reasons_, &std::string::empty);
  if (found == reasons_.end()) return {};
  return {kStates[found - reasons_.begin()], *found};
}

ReaderThreads::ReaderThreads(const OpenOptions& options, HealthMonitor& health,
                             sql::OpenSession open)
    : ReadPool(options.queue_limit), options_(options), health_(health), open_(std::move(open)) {
  for (unsigned i = 0; i < options.readers; ++i)
    threads_.emplace_back("a store reader", [this](const auto&) { run(); });
}

ReaderThreads::~ReaderThreads() { stop(); }

void ReaderThreads::stop() {
  queue_.close();
  for (Thread& thread : threads_) thread.stop();
  threads_.clear();
}

void ReaderThreads::run() {
  std::unique_ptr<sql::Session> session;
  while (const auto taken = queue_.take_one()) {
    Job<const Stores>& job = **taken;
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
      if (error->code == ErrorCode::StorageCorrupt) health_.note(Finding::Damage, error->message);
    }
    tell(job, std::move(error));
  }
}

/// In a transaction, so that all statements of the job see the same state.
void ReaderThreads::read(std::unique_ptr<sql::Session>& session, Job<const Stores>& job) {
  if (!session) session = open_();
  job.prepare();
  session->begin_reading();
  job.run(session->stores());
  session->commit();
}

}  // namespace fitgauge::store

#include "db/sqlite/scrub.hpp"

#include <fmt/format.h>

#include "db/sqlite/file_check.hpp"
#include "db/sqlite/session.hpp"
#include "db/sqlite/verifier.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

/// A piece that took t is followed by a rest of so many t: six percent of a processor.
constexpr int kRest = 15;

}  // namespace

Scrub::Scrub(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
             bool check_file_first)
    : options_(options), clock_(clock), health_(health) {
  if (check_file_first) {
    health.checking(
        fmt::format("{} is being checked", (options.directory / kDatabaseFile).string()));
  }
  thread_ = Thread("the scrub", [this, check_file_first](const std::stop_token& stop) {
    run(stop, check_file_first);
  });
}

void Scrub::run(const std::stop_token& stop, bool check_file_first) {
  if (check_file_first) check_file(stop);
  do {
    pass(stop);
  } while (rest(stop, options_.scrub_interval));
}

void Scrub::check_file(const std::stop_token& stop) {
  const Result<void> checked = store::check_file(options_.directory / kDatabaseFile, stop);
  if (stop.stop_requested()) return;
  checked ? health_.check_passed() : health_.damaged(checked.error().message);
}

void Scrub::pass(const std::stop_token& stop) {
  try {
    sqlite::Session session(options_, clock_, sqlite::Mode::Read);
    Verifier verifier(session, options_.check_measurement);
    using Time = std::chrono::steady_clock;
    auto begin = Time::now();
    const auto go_on = [&] {
      const bool goes_on = rest(stop, kRest * (Time::now() - begin));
      begin = Time::now();
      return goes_on;
    };
    if (const std::optional<std::string> finding = verifier.first_altered_row(go_on)) {
      health_.damaged(fmt::format("{}. Restore a backup", *finding));
    }
  } catch (const StorageFailure& failure) {
    // What else fails here (no memory, no descriptors) is for the next pass.
    if (failure.error().code == ErrorCode::StorageCorrupt) health_.damaged(failure.error().message);
  } catch (const std::exception& bug) {
    if (options_.job_threw) {
      options_.job_threw({ErrorCode::Internal, fmt::format("the scrub failed: {}", bug.what())});
    }
  }
}

bool Scrub::rest(const std::stop_token& stop, std::chrono::nanoseconds time) {
  std::unique_lock lock(mutex_);
  stopped_.wait_for(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace fitgauge::store

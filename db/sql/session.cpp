#include "db/sql/session.hpp"

#include <utility>

namespace fitgauge::store {

template <class Change>
void HealthMonitor::change(Change change) {
  const std::lock_guard lock(mutex_);
  const HealthState before = current().state;
  change();
  const Health after = current();
  if (after.state != before && report_) report_(after);
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

void HealthMonitor::writes_failed(std::string reason) {
  change([&] { write_failure_ = std::move(reason); });
}

void HealthMonitor::writes_succeeded() {
  change([&] { write_failure_.clear(); });
}

Health HealthMonitor::health() const {
  const std::lock_guard lock(mutex_);
  return current();
}

Health HealthMonitor::current() const {
  if (!damage_.empty()) return {HealthState::Damaged, damage_};
  if (!write_failure_.empty()) return {HealthState::WritesFailing, write_failure_};
  if (!checking_.empty()) return {HealthState::Checking, checking_};
  return {};
}

}  // namespace fitgauge::store

#include "sqlite/health_monitor.hpp"

#include <utility>

namespace fitgauge::store {

void HealthMonitor::checking(std::string reason) {
  const std::lock_guard lock(mutex_);
  checking_ = std::move(reason);
}

void HealthMonitor::check_passed() {
  const std::lock_guard lock(mutex_);
  checking_.clear();
}

void HealthMonitor::damaged(std::string reason) {
  const std::lock_guard lock(mutex_);
  if (damage_.empty()) damage_ = std::move(reason);
}

void HealthMonitor::writes_failed(std::string reason) {
  const std::lock_guard lock(mutex_);
  write_failure_ = std::move(reason);
}

void HealthMonitor::writes_succeeded() {
  const std::lock_guard lock(mutex_);
  write_failure_.clear();
}

Health HealthMonitor::health() const {
  const std::lock_guard lock(mutex_);
  if (!damage_.empty()) return {HealthState::Damaged, damage_};
  if (!write_failure_.empty()) return {HealthState::WritesFailing, write_failure_};
  if (!checking_.empty()) return {HealthState::Checking, checking_};
  return {};
}

}  // namespace fitgauge::store

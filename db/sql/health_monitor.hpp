#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "db/store/health.hpp"

namespace fitgauge::store {

/// Collects what the writer, the readers and the checks find out, and reports each change of state
/// once. Thread-safe.
class HealthMonitor {
 public:
  using Report = std::function<void(const Health&)>;

  /// @param report called in the order of the changes, on the thread that found out.
  explicit HealthMonitor(Report report = {}) : report_(std::move(report)) {}

  void checking(std::string reason);
  void check_passed();
  void damaged(std::string reason);  ///< for good; the first reason stays
  void writes_failed(std::string reason);
  void writes_succeeded();

  Health health() const;

 private:
  template <class Change>
  void change(Change change);
  Health current() const;

  const Report report_;
  mutable std::mutex mutex_;
  std::string checking_;
  std::string damage_;
  std::string write_failure_;
};

}  // namespace fitgauge::store

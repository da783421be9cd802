#pragma once

#include <mutex>
#include <string>

#include "store/health.hpp"

namespace fitgauge::store {

/// Collects what the writer, the readers and the background check find out. Thread-safe.
class HealthMonitor {
 public:
  void checking(std::string reason);
  void check_passed();
  void damaged(std::string reason);  ///< for good; the first reason stays
  void writes_failed(std::string reason);
  void writes_succeeded();

  Health health() const;

 private:
  mutable std::mutex mutex_;
  std::string checking_;
  std::string damage_;
  std::string write_failure_;
};

}  // namespace fitgauge::store

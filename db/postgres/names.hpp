#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {

/// What the application keeps of the database in memory (table revisions, origins, keys of the
/// log), as other daemons change it too: it is told before a transaction shows rows that need what
/// is new.
class Names {
 public:
  /// @param changed see OpenOptions::names_changed.
  explicit Names(std::function<bool(const Stores&)> changed) : changed_(std::move(changed)) {}

  void look(std::int64_t version, const Stores& stores) {
    if (version <= seen_ || !changed_) return;
    const std::lock_guard lock(mutex_);
    if (version > seen_ && changed_(stores)) seen_ = version;
  }

 private:
  const std::function<bool(const Stores&)> changed_;
  std::mutex mutex_;
  std::atomic<std::int64_t> seen_{-1};
};

}  // namespace fitgauge::store::postgres

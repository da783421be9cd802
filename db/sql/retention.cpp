#include "db/sql/writer_engine.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "db/store/stores.hpp"

namespace fitgauge::store {

std::optional<Timestamp> Retention::time(const SteadyTime& clock, const Stores& stores) {
  const bool has_held = clock.held >= std::chrono::hours(24);
  if (has_begun_ && !has_held) return time_;
  const std::optional<Timestamp> newest = stores.measurements.newest_received_at();
  has_begun_ = true;
  if (newest) {
    time_ = std::min(*newest, clock.time);
  } else if (has_held) {
    time_ = clock.time;
  }
  return time_;
}

void Retention::deleted(std::int64_t keys, std::int64_t runs) {
  keys_ += keys;
  runs_ += runs;
}

std::optional<std::string> Retention::report(std::chrono::nanoseconds now, bool more) {
  const bool is_soon = reported_ && now - *reported_ < std::chrono::hours(1);
  if (keys_ + runs_ == 0 || more || is_soon) return std::nullopt;
  std::string sentence = fmt::format(
      "deleted {} idempotency keys and {} finished runs with their files: expired at {}", keys_,
      runs_, time_ ? format_rfc3339(*time_) : "");
  keys_ = runs_ = 0;
  reported_ = now;
  return sentence;
}

}  // namespace fitgauge::store

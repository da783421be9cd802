#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "cli/http_client.hpp"

namespace fitgauge::cli {

/// How long to wait before a request is sent again: 0.2 s, then twice as long each time up to 10 s,
/// or as long as the service says, until the waiting adds up to the budget.
class Backoff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  explicit Backoff(std::chrono::seconds budget) : left_(budget) {}

  /// @param retry_after what the answer said. @returns nothing when the budget is used up.
  std::optional<Milliseconds> next(std::optional<std::chrono::seconds> retry_after);

 private:
  static constexpr Milliseconds kFirst{200};
  static constexpr Milliseconds kLongest{10'000};

  Milliseconds left_;
  Milliseconds delay_ = kFirst;
};

/// Told before each wait: why, and for how long.
using RetryNotice = std::function<void(const Failure&, std::chrono::milliseconds)>;

/// A new idempotency key.
std::string new_idempotency_key();

/// Sends a request that may be repeated (a GET, or one with an idempotency key) until it gets an
/// answer that is final. @errors NoAnswer, with the last reason, when the budget is used up.
Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice);

}  // namespace fitgauge::cli

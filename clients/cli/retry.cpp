#include "cli/retry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <thread>

#include "cli/problem.hpp"

namespace fitgauge::cli {

std::optional<Backoff::Milliseconds> Backoff::next(
    std::optional<std::chrono::seconds> retry_after) {
  Milliseconds wait = delay_;
  if (retry_after) wait = std::max(wait, Milliseconds(*retry_after));
  if (wait > left_) return std::nullopt;
  left_ -= wait;
  delay_ = std::min(delay_ * 2, kLongest);
  return wait;
}

std::string new_idempotency_key() {
  std::random_device entropy;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", entropy(), entropy(), entropy(), entropy());
}

Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice) {
  for (;;) {
    auto answer = client.send(request);
    if (answer && !is_temporary(*answer)) return answer;
    const Failure failure = answer ? failure_of(*answer, client.url()) : answer.error();
    const auto wait = backoff.next(answer ? answer->retry_after : std::nullopt);
    if (!wait) return failure;
    notice(failure, *wait);
    std::this_thread::sleep_for(*wait);
  }
}

}  // namespace fitgauge::cli

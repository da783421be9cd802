#include "http/engine/next_reads.hpp"

#include <algorithm>
#include <cstddef>

#include "http/engine/connection.hpp"

namespace fitgauge::http {

namespace {
/// One turn in vain among so many answers is not felt.
constexpr unsigned kUntilRetry = 256;
}  // namespace

bool NextReads::put(Connection& connection) {
  if (until_retry_ > 0) {
    --until_retry_;
    return false;
  }
  // Posted first: where memory for it is lacking, nothing waits for a turn that does not come.
  if (waiting_.empty()) asio::post(context_, [this] { read(); });
  waiting_.push_back(connection.shared_from_this());
  return true;
}

void NextReads::read() {
  turn_.swap(waiting_);
  const auto found = std::count_if(turn_.begin(), turn_.end(),
                                   [](const auto& each) { return each->read_in_turn(); });
  if (2 * static_cast<std::size_t>(found) < turn_.size()) until_retry_ = kUntilRetry;
  turn_.clear();
}

}  // namespace fitgauge::http

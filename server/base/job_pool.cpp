#include "base/job_pool.hpp"

#include <string>

namespace fitgauge {

Error JobPool::full() {
  return {ErrorCode::Overloaded, "too much work of this kind waits already; try again soon"};
}

Error JobPool::ended() { return {ErrorCode::ShuttingDown, "the service is shutting down"}; }

Error JobPool::internal(const std::exception& bug) {
  return {ErrorCode::Internal, std::string("the work on a request failed: ") + bug.what()};
}

Error JobPool::beyond_bound(Allowance::Spent spent) {
  if (spent == Allowance::Spent::Stop) return ended();
  const std::string_view what = spent == Allowance::Spent::Time ? "time" : "memory";
  return {ErrorCode::FiguresLimit,
          "the figure takes more " + std::string(what) +
              " than the service gives to one: order it of fewer values, or with fewer trials"};
}

}  // namespace fitgauge

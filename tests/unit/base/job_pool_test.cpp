#include "base/worker_pool.hpp"

#include <doctest/doctest.h>

#include <future>
#include <latch>

namespace fitgauge {
namespace {

using Outcome = std::future<Result<int>>;

/// What a pool makes of a job.
template <class Compute>
Outcome outcome_of(JobPool& pool, Compute compute) {
  const auto promise = std::make_shared<std::promise<Result<int>>>();
  pool.run(std::move(compute), [promise](Result<int> made) { promise->set_value(made); });
  return promise->get_future();
}

/// Works until its allowance is spent.
Result<int> endless() {
  while (!Allowance::of_thread().is_spent()) std::this_thread::yield();
  return 1;
}

/// A bound that no test reaches.
constexpr JobBound kAmple{std::chrono::hours(1), std::size_t{1} << 40U};

TEST_CASE("a job hands over what it returns, and what it throws as an internal error") {
  JobPool pool("a test", 1, 3);
  CHECK(outcome_of(pool, []() -> Result<int> { return 5; }).get().value() == 5);
  const auto fail = []() -> Result<int> { return Error{ErrorCode::NotFound, "not here"}; };
  CHECK(outcome_of(pool, fail).get().error().code == ErrorCode::NotFound);
  const auto broken = []() -> Result<int> { throw std::runtime_error("broken"); };
  CHECK(outcome_of(pool, broken).get().error().code == ErrorCode::Internal);
}

TEST_CASE("a job beyond its bound of time or memory is refused, also when it has returned") {
  const auto code_of = [](JobBound bound, Result<int> (*compute)()) {
    JobPool pool("a test", 1, 1, bound);
    const auto made = outcome_of(pool, compute).get();
    return made ? ErrorCode::Internal : made.error().code;
  };
  JobBound bound = kAmple;
  SUBCASE("time") { bound.time = {}; }
  SUBCASE("memory") { bound.memory_bytes = 1000; }
  const auto large = []() -> Result<int> {
    static thread_local std::vector<char> kept;
    kept.resize(1'000'000);
    return 1;
  };
  CHECK(code_of(bound, large) == ErrorCode::FiguresLimit);
  CHECK(code_of(kAmple, large) == ErrorCode::Internal);  // it has a result
}

TEST_CASE("a loop of one job does not see the allowance of another") {
  JobPool pool("a test", 1, 2, JobBound{{}, std::size_t{1} << 40U});
  CHECK(outcome_of(pool, endless).get().error().code == ErrorCode::FiguresLimit);
  CHECK_FALSE(Allowance::of_thread().is_spent());
  JobPool unbounded("a test", 1, 2);
  const auto is_spent = []() -> Result<int> { return Allowance::of_thread().is_spent() ? 1 : 0; };
  CHECK(outcome_of(unbounded, is_spent).get().value() == 0);
}

TEST_CASE("calling off ends a bounded job under way and refuses those that wait") {
  JobPool pool("a test", 1, 1, kAmple);
  std::latch begun(1);
  Outcome under_way = outcome_of(pool, [&begun] {
    begun.count_down();
    return endless();
  });
  begun.wait();
  Outcome waiting = outcome_of(pool, []() -> Result<int> { return 1; });
  CHECK(outcome_of(pool, endless).get().error().code == ErrorCode::Overloaded);
  pool.call_off();
  for (Outcome* outcome : {&under_way, &waiting}) {
    CHECK(outcome->get().error().code == ErrorCode::ShuttingDown);
  }
  CHECK(outcome_of(pool, endless).get().error().code == ErrorCode::ShuttingDown);
}

}  // namespace
}  // namespace fitgauge

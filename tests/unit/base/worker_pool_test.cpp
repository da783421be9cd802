#include "base/worker_pool.hpp"

#include <doctest/doctest.h>
#include <fstream>
#include <future>
#include <latch>

namespace fitgauge {
namespace {

using Outcome = std::future<Result<int>>;

/// A job that goes on until it is let go.
struct LongJob {
  void operator()() {
    begun.set_value();
    let_go.get_future().wait();
  }

  std::promise<void> begun;
  std::promise<void> let_go;
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Pages of this process in memory (proc(5), statm).
long pages_resident() {
  std::ifstream file("/proc/self/statm");
  long size = 0;
  long resident = 0;
  file >> size >> resident;
  return resident;
}

TEST_CASE("after a long job the free memory between used blocks goes back to the kernel") {
  constexpr long kFew = 2'000;
  constexpr std::size_t kAlmostAPage = 4'000;
  std::unique_ptr<char[]> kept;
  long most = 0;
  WorkerPool pool("a test", 1, 1);
  const long before = pages_resident();
  REQUIRE(pool.submit([&] {
    std::vector<std::unique_ptr<char[]>> blocks(5 * kFew);
    for (auto& block : blocks) block = std::make_unique<char[]>(kAlmostAPage);
    kept = std::move(blocks.back());
    most = pages_resident();
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // long
  }));
  pool.stop();
  CHECK(most - before > 4 * kFew);
  CHECK(pages_resident() - before < kFew);
}
#endif

TEST_CASE("a pool refuses what its queue has no room for and finishes what it took") {
  LongJob job;
  std::atomic<int> done{0};
  WorkerPool pool("a test", 1, 2);
  REQUIRE(pool.submit([&] {
    job();
    ++done;
  }));
  job.begun.get_future().wait();
  CHECK(pool.submit([&] { ++done; }));
  CHECK(pool.submit([&] { ++done; }));
  CHECK_FALSE(pool.submit([&] { ++done; }));
  job.let_go.set_value();
  pool.stop();
  CHECK(done == 3);
  CHECK_FALSE(pool.submit([&] { ++done; }));
}

TEST_CASE("a job that waits can be taken back, once, and makes room") {
  LongJob job;
  std::atomic<int> done{0};
  WorkerPool pool("a test", 1, 1);
  const auto running = pool.submit([&] { job(); });
  job.begun.get_future().wait();
  const auto waiting = pool.submit([&] { done += 1; }).value();
  CHECK_FALSE(pool.withdraw(*running));
  CHECK(pool.withdraw(waiting));
  CHECK_FALSE(pool.withdraw(waiting));
  CHECK(pool.submit([&] { done += 10; }));
  job.let_go.set_value();
  pool.stop();
  CHECK(done == 10);
}

TEST_CASE("a job that throws ends neither its thread nor the jobs behind it") {
  std::atomic<int> done{0};
  WorkerPool pool("a test", 1, 2);
  CHECK(pool.submit([] { throw std::runtime_error("a bug"); }));
  CHECK(pool.submit([&] { ++done; }));
  pool.stop();
  CHECK(done == 1);
}

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

#include "base/worker_pool.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <future>

namespace fitgauge {
namespace {

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
  const auto waiting = pool.submit([&] { done += 1; });
  REQUIRE(waiting);
  CHECK_FALSE(pool.withdraw(*running));
  CHECK(pool.withdraw(*waiting));
  CHECK_FALSE(pool.withdraw(*waiting));
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

}  // namespace
}  // namespace fitgauge

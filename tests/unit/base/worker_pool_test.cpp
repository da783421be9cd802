#include "base/worker_pool.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <future>
#include <stdexcept>

namespace fitgauge {
namespace {

TEST_CASE("a pool refuses what its queue has no room for and finishes what it took") {
  std::promise<void> gate;
  const auto opened = gate.get_future().share();
  std::promise<void> begun;
  std::atomic<int> done{0};
  WorkerPool pool("a test", 1, 2);
  REQUIRE(pool.submit([&] {
    begun.set_value();
    opened.wait();
    ++done;
  }));
  begun.get_future().wait();
  CHECK(pool.submit([&] { ++done; }));
  CHECK(pool.submit([&] { ++done; }));
  CHECK_FALSE(pool.submit([&] { ++done; }));
  gate.set_value();
  pool.stop();
  CHECK(done == 3);
  CHECK_FALSE(pool.submit([&] { ++done; }));
}

TEST_CASE("a job that waits can be taken back, once, and makes room") {
  std::promise<void> gate;
  const auto opened = gate.get_future().share();
  std::promise<void> begun;
  std::atomic<int> done{0};
  WorkerPool pool("a test", 1, 1);
  const auto running = pool.submit([&] {
    begun.set_value();
    opened.wait();
  });
  begun.get_future().wait();
  const auto waiting = pool.submit([&] { done += 1; });
  REQUIRE(waiting);
  CHECK_FALSE(pool.withdraw(*running));
  CHECK(pool.withdraw(*waiting));
  CHECK_FALSE(pool.withdraw(*waiting));
  CHECK(pool.submit([&] { done += 10; }));
  gate.set_value();
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

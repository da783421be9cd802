#include "app/runs/worker_pool.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <future>

namespace fitgauge::app {
namespace {

TEST_CASE("a pool refuses what its queue has no room for and finishes what it took") {
  std::promise<void> gate;
  const auto opened = gate.get_future().share();
  std::promise<void> begun;
  std::atomic<int> done{0};
  WorkerPool pool(1, 2);
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

}  // namespace
}  // namespace fitgauge::app

#include "base/allowance.hpp"

#include <doctest/doctest.h>

namespace fitgauge {
namespace {

using Spent = Allowance::Spent;

TEST_CASE("what a thread holds is counted in every form it can be taken") {
  struct alignas(64) Wide {
    char bytes[64];
  };
  const std::int64_t before = thread_memory();
  {
    const std::vector<char> bytes(100'000);
    const auto one = std::make_unique<std::string>(1000, 'x');
    const auto wide = std::make_unique<Wide[]>(10);
    const std::map<int, int> tree{{1, 2}, {3, 4}};
    const std::unique_ptr<char[]> quiet(new (std::nothrow) char[5000]);
    CHECK(thread_memory() - before >= 100'000 + 1000 + 640 + 5000);
    CHECK(thread_memory() - before < 110'000);
  }
  CHECK(thread_memory() == before);
  std::int64_t other = 0;
  std::thread([&other] {
    const std::vector<char> bytes(1 << 20);
    other = thread_memory();
  }).join();
  CHECK(other >= 1 << 20);
  CHECK(thread_memory() - before < 1 << 20);
}

TEST_CASE("what one thread takes and another gives back is handed over") {
  const std::int64_t before = thread_memory();
  std::string text;
  std::int64_t taken = 0;
  std::thread([&] {
    const std::int64_t begun = thread_memory();
    text.assign(100'000, 'x');
    taken = thread_memory() - begun;
    hand_over_memory(-taken);
    CHECK(thread_memory() == begun);
  }).join();
  hand_over_memory(before + taken - thread_memory());
  CHECK(thread_memory() - before >= 100'000);
  std::string().swap(text);
  CHECK(thread_memory() == before);
}

TEST_CASE("an allowance is spent by time, by memory or by a stop, and stays so") {
  Allowance unlimited;
  CHECK(unlimited.look() == Spent::Nothing);

  Allowance late(std::chrono::milliseconds(0), 1 << 20, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(late.found() == Spent::Nothing);  // nobody has looked
  CHECK(late.look() == Spent::Time);
  CHECK(late.found() == Spent::Time);

  Allowance small(std::chrono::hours(1), 1000, {});
  {
    const std::vector<char> bytes(2000);
    CHECK(small.look() == Spent::Memory);
  }
  CHECK(small.look() == Spent::Memory);

  std::stop_source source;
  Allowance stopped(std::chrono::hours(1), 1 << 20, source.get_token());
  CHECK(stopped.look() == Spent::Nothing);
  source.request_stop();
  CHECK(stopped.look() == Spent::Stop);

  Allowance counted(std::chrono::hours(1), 1 << 20, {});
  counted.spend_at_look(3, Spent::Time);
  CHECK(counted.look() == Spent::Nothing);
  CHECK(counted.look() == Spent::Nothing);
  CHECK(counted.look() == Spent::Time);
  CHECK(counted.look() == Spent::Time);
}

TEST_CASE("a shared thing counts as what it is said to hold, and a cache's not at all") {
  Allowance allowance(std::chrono::hours(1), 10'000, {});
  const auto cached = allowance.uncounted([] { return std::vector<char>(50'000); });
  CHECK(allowance.look() == Spent::Nothing);
  allowance.share(9'000);
  CHECK(allowance.look() == Spent::Nothing);
  allowance.share(2'000);
  CHECK(allowance.look() == Spent::Memory);
}

}  // namespace
}  // namespace fitgauge

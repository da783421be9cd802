#include "base/thread.hpp"

#include <doctest/doctest.h>

#include <pthread.h>
#include <future>

using namespace fitgauge;

namespace {
std::string said;
std::atomic<int> bugs{0};
}  // namespace

TEST_CASE("what a thread's body throws is reported, and the body begins again") {
  said.clear();
  report_bugs_to([](std::string_view place, std::string_view what) {
    said += std::string(place) + ": " + std::string(what) + "\n";
  });
  int begun = 0;
  std::promise<void> reached;
  Thread thread("a loop", [&](const std::stop_token&) {
    if (++begun == 1) throw std::runtime_error("broken");
    if (begun == 2) throw 5;
    reached.set_value();
  });
  reached.get_future().wait();
  thread.stop();
  CHECK(begun == 3);
  CHECK(said == "a loop: broken\na loop: an exception of unknown type\n");
}

TEST_CASE(
    "a body that always throws ends when it is asked to, and does not keep a processor busy") {
  bugs = 0;
  report_bugs_to([](std::string_view, std::string_view) { ++bugs; });
  {
    const Thread thread("a loop", [](const std::stop_token&) { throw std::logic_error("broken"); });
    while (bugs < 2) std::this_thread::yield();
  }
  CHECK(bugs < 5);
}

TEST_CASE("a thread that never began or has ended can be stopped") {
  Thread thread;
  CHECK_FALSE(thread.has_begun());
  thread.stop();
  thread = Thread("a loop", [](const std::stop_token&) {});
  CHECK(thread.has_begun());
  thread.stop();
  thread.stop();
  CHECK_FALSE(thread.has_begun());
}

TEST_CASE("a thread shows the first 15 bytes of its place, without the article") {
  for (const auto& [place, shown] : {std::pair{"orders", "orders"},
                                     {"the log", "log"},
                                     {"an I/O thread", "I/O thread"},
                                     {"a place of many words", "place of many w"}}) {
    std::string name;
    std::promise<void> named;  // by whoever starts it
    Thread thread(place, [&name, begun = named.get_future().share()](const std::stop_token&) {
      begun.wait();
      std::array<char, 16> bytes{};
      pthread_getname_np(pthread_self(), bytes.data(), bytes.size());
      name = bytes.data();
    });
    named.set_value();
    thread.stop();
    CHECK(name == shown);
  }
}

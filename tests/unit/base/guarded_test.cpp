#include "base/thread.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;

namespace {
std::string reported;
}

TEST_CASE("what a guarded call throws is reported and goes no further") {
  report_bugs_to([](std::string_view place, std::string_view what) {
    reported += std::string(place) + ": " + std::string(what) + "\n";
  });
  bool called = false;
  CHECK(guarded("a job", [&] { called = true; }));
  CHECK(called);
  CHECK(reported.empty());
  CHECK_FALSE(guarded("a job", [] { throw std::runtime_error("broken"); }));
  CHECK_FALSE(guarded("a completion", [] { throw 5; }));
  CHECK(reported == "a job: broken\na completion: an exception of unknown type\n");
}

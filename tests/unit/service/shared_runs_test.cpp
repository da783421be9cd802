#include "service/runs/active_run.hpp"

#include <doctest/doctest.h>

#include <future>

#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "service_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::app;

namespace {
std::string bugs_of_looks;
}

TEST_CASE("a look for the runs of other daemons that fails is not the last one") {
  bugs_of_looks.clear();
  report_bugs_to([](std::string_view place, std::string_view what) {
    bugs_of_looks += std::string(place) + ": " + std::string(what) + "\n";
  });
  const TemporaryFolder folder;
  const SystemClock clock;
  const auto database = store::sqlite::open_database({.directory = folder.path()}, clock).value();
  int looks = 0;
  std::promise<void> again;
  SharedRuns shared(*database, {.has_any =
                                    [&] {
                                      if (++looks == 1) throw std::logic_error("broken");
                                      if (looks == 2) again.set_value();
                                      return false;
                                    },
                                .cancel = [](std::int64_t) {}});
  again.get_future().wait();
  shared.stop();
  CHECK(bugs_of_looks == "shared runs: broken\n");
}

// What a completion throws concerns that completion alone: the storage threads go on.

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <string>

#include "base/guarded.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

std::atomic<int> bugs_reported{0};

void count_bugs() {
  bugs_reported = 0;
  report_bugs_to([](std::string_view, std::string_view) { ++bugs_reported; });
}

}  // namespace

TEST_CASE("a completion that throws ends neither the reader nor the writer") {
  count_bugs();
  Fixture fixture;
  const auto fails = [](const Result<int>&) { throw std::logic_error("a completion's bug"); };
  for (int i = 0; i < 4; ++i) {  // more than there are threads
    fixture.database->readers().submit([](const Stores&) -> Result<int> { return 1; }, fails);
    fixture.database->readers().submit(
        [](const Stores&) -> Result<int> { throw std::logic_error("a job's bug"); }, fails);
    fixture.database->writer().submit([](Stores&) -> Result<int> { return 1; }, fails);
    fixture.database->writer().submit(
        [](Stores&) -> Result<int> { throw std::logic_error("a job's bug"); }, fails);
  }
  CHECK(fixture.append(sample_row()).has_value());
  CHECK(fixture.last_id() == 1);
  fixture.database->drain();
  CHECK(bugs_reported == 16);
}

TEST_CASE("a listener of commits that throws does not end the writer") {
  count_bugs();
  Fixture fixture;
  fixture.database.reset();
  fixture.options.committed = [] { throw std::logic_error("a listener's bug"); };
  fixture.open();
  CHECK(fixture.append(sample_row()).has_value());
  CHECK(fixture.append(sample_row()).has_value());
  fixture.database->drain();
  CHECK(bugs_reported == 2);
}

TEST_CASE("draining runs what is queued and refuses what comes later") {
  Fixture fixture;
  std::atomic<int> done{0};
  for (int i = 0; i < 50; ++i) {
    fixture.database->readers().submit([](const Stores&) -> Result<int> { return 1; },
                                       [&](const Result<int>& outcome) { done += *outcome; });
    fixture.database->writer().submit([](Stores&) -> Result<int> { return 1; },
                                      [&](const Result<int>& outcome) { done += *outcome; });
  }
  fixture.database->drain();
  CHECK(done == 100);
  CHECK(fixture.append(sample_row()).error().code == ErrorCode::ShuttingDown);
  CHECK(fixture.read([](const Stores&) -> Result<int> { return 1; }).error().code ==
        ErrorCode::ShuttingDown);
  fixture.database->drain();
}

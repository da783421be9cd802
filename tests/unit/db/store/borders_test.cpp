// What a completion throws concerns that completion alone: the storage threads go on.

#include <doctest/doctest.h>

#include <future>

#include "base/thread.hpp"
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
  fixture.reopen([&](OpenOptions& options) {
    options.committed = [] { throw std::logic_error("a listener's bug"); };
  });
  CHECK(fixture.append(sample_row()).has_value());
  CHECK(fixture.append(sample_row()).has_value());
  fixture.database->drain();
  CHECK(bugs_reported == 2);
}

TEST_CASE("of several jobs in one transaction each fails by itself, and so does a lone one") {
  Fixture fixture;
  MeasurementRow wrong = sample_row();
  wrong.lower_deviation_nm = wrong.upper_deviation_nm + 1;
  std::promise<void> all_wait;
  std::vector<std::future<bool>> stored;
  const auto submit = [&](auto work) {
    const auto outcome = std::make_shared<std::promise<bool>>();
    stored.push_back(outcome->get_future());
    fixture.database->writer().submit(
        work, [outcome](const Result<bool>& result) { outcome->set_value(result.has_value()); });
  };
  const auto append = [](const MeasurementRow& row) {
    return [row](Stores& stores) -> Result<bool> {
      const auto appended = append_numbered(stores, std::span(&row, 1));
      if (!appended) return appended.error();
      return true;
    };
  };
  const auto append_and_refuse = [](const MeasurementRow& row) {
    return [row](Stores& stores) -> Result<bool> {
      append_numbered(stores, std::span(&row, 1)).has_value();
      return Error{ErrorCode::FieldInvalid, "no"};
    };
  };
  submit([&](Stores&) -> Result<bool> {
    all_wait.get_future().wait();
    return true;
  });
  submit(append(sample_row()));
  submit(append_and_refuse(wrong));
  submit(append(sample_row()));
  submit(append(wrong));
  submit(append(sample_row()));
  all_wait.set_value();
  std::vector<bool> outcomes;
  for (auto& outcome : stored) outcomes.push_back(outcome.get());
  CHECK(outcomes == std::vector<bool>{true, true, false, true, false, true});
  CHECK(fixture.last_id() == 3);

  CHECK_FALSE(fixture.append(wrong).has_value());
  CHECK(fixture.database->health().state == HealthState::Ok);
  CHECK(fixture.append(sample_row()).has_value());
  CHECK(fixture.last_id() == 4);
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

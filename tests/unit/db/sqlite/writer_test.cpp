#include "db/store/jobs.hpp"

#include <latch>

#include "db/sqlite/connection.hpp"
#include "fixture.hpp"
#include "full_disk.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

IdempotentRequest request(std::string key, std::string_view body = "body") {
  return {.caller = "press-3",
          .method = "POST",
          .path = "/v1/measurements",
          .key = std::move(key),
          .body = sha256(body)};
}

Result<StoredAnswer> store_one(Stores& stores) {
  MeasurementRow row = sample_row();
  const auto ids = append_numbered(stores, std::span(&row, 1));
  if (!ids) return ids.error();
  return StoredAnswer{.status = 201,
                      .content_type = "application/json",
                      .location = "/v1/measurements/" + std::to_string(ids->first),
                      .body = "{}"};
}

Result<StoredAnswer> post_once(Fixture& fixture, const IdempotentRequest& once) {
  std::promise<Result<StoredAnswer>> promise;
  fixture.database->writer().submit_once(
      once, store_one, [&](Result<StoredAnswer> answer) { promise.set_value(std::move(answer)); });
  return promise.get_future().get();
}

}  // namespace

TEST_CASE("an error of one job undoes its own changes and no other's") {
  Fixture fixture;
  std::latch delivered(3);
  const auto submit = [&](auto work, auto done) {
    fixture.database->writer().submit(work, [done, &delivered](Result<int> outcome) {
      done(std::move(outcome));
      delivered.count_down();
    });
  };
  const auto append_then = [](const Result<int>& outcome) {
    return [outcome](Stores& stores) -> Result<int> {
      MeasurementRow row = sample_row();
      REQUIRE(append_numbered(stores, std::span(&row, 1)).has_value());
      return outcome;
    };
  };
  submit(append_then(1), [](const Result<int>& outcome) { CHECK(*outcome == 1); });
  submit(append_then(Error{ErrorCode::FieldInvalid, "no"}), [](const Result<int>& outcome) {
    CHECK(outcome.error().code == ErrorCode::FieldInvalid);
  });
  submit(
      [](Stores& stores) -> Result<int> {
        stores.documents.put({.kind = DocumentKind::Setup, .name = "s", .text = "{}"});
        throw std::logic_error("a bug");
      },
      [](const Result<int>& outcome) {
        CHECK(outcome.error().code == ErrorCode::Internal);
        CHECK(outcome.error().message.find("a bug") != std::string::npos);
      });
  delivered.wait();
  CHECK(fixture.last_id() == 1);
  CHECK_FALSE(fixture.see(
      [](const Stores& stores) { return !stores.documents.list(DocumentKind::Setup).empty(); }));
}

TEST_CASE("what arrives during a commit is the next batch, and all of it is kept") {
  Fixture fixture;
  SUBCASE("group commit") {}
  SUBCASE("each its own commit") {
    fixture.reopen([](OpenOptions& options) { options.commit_each = true; });
  }
  constexpr int kThreads = 8;
  constexpr int kRows = 20;
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&fixture] {
      for (int i = 0; i < kRows; ++i) CHECK(fixture.append(sample_row()).has_value());
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(fixture.last_id() == kThreads * kRows);
}

TEST_CASE("a full queue refuses, and a shutdown runs what is queued") {
  Fixture fixture;
  fixture.reopen([](OpenOptions& options) { options.queue_limit = 4; });
  std::latch started(1);
  std::latch release(1);
  std::atomic<int> done = 0;
  std::atomic<int> busy = 0;
  fixture.database->writer().submit(
      [&](Stores&) -> Result<int> {
        started.count_down();
        release.wait();
        return 0;
      },
      [](const Result<int>&) {});
  started.wait();
  for (int i = 0; i < 6; ++i) {
    fixture.database->writer().submit(
        [](Stores& stores) {
          MeasurementRow row = sample_row();
          return append_numbered(stores, std::span(&row, 1));
        },
        [&](const Result<IdRange>& outcome) {
          if (outcome) {
            ++done;
          } else if (outcome.error().code == ErrorCode::StorageBusy) {
            ++busy;
          }
        });
  }
  CHECK(busy == 2);
  release.count_down();
  fixture.database.reset();
  CHECK(done == 4);
  fixture.open();
  CHECK(fixture.last_id() == 4);
}

TEST_CASE("a request with a key is done once and replayed") {
  Fixture fixture;
  const auto first = post_once(fixture, request("k")).value();
  CHECK_FALSE(first.replayed);
  const auto second = post_once(fixture, request("k")).value();
  CHECK(second.replayed);
  CHECK(second.status == 201);
  CHECK(second.location == first.location);
  CHECK(second.content_type == "application/json");
  CHECK(second.body == first.body);
  CHECK(post_once(fixture, request("k", "other")).error().code == ErrorCode::IdempotencyKeyReused);
  CHECK(post_once(fixture, request("other")).has_value());
  CHECK(fixture.last_id() == 2);
}

namespace {

Result<std::int64_t> purge(Fixture& fixture) {
  return fixture.write([now = fixture.clock.now()](Stores& stores) -> Result<std::int64_t> {
    return stores.idempotency.purge(now, 10);
  });
}

}  // namespace

TEST_CASE("an expired key counts until it is purged, and is as new from then on") {
  Fixture fixture;
  REQUIRE(post_once(fixture, request("k")).has_value());
  fixture.clock.advance(std::chrono::hours(31 * 24));
  CHECK(post_once(fixture, request("k"))->replayed);
  CHECK(*purge(fixture) == 1);
  CHECK_FALSE(post_once(fixture, request("k", "other"))->replayed);
}

TEST_CASE("a key that is kept for ever is never as new") {
  Fixture fixture;
  IdempotentRequest once = request("k");
  once.is_kept_for_ever = true;
  REQUIRE(post_once(fixture, once).has_value());
  fixture.clock.advance(std::chrono::hours(31 * 24 * 100));
  CHECK(*purge(fixture) == 0);
  CHECK(post_once(fixture, once)->replayed);
}

TEST_CASE("an answer that is not 2xx is not kept") {
  Fixture fixture;
  const auto refuse = [&](const IdempotentRequest& once) {
    std::promise<Result<StoredAnswer>> promise;
    fixture.database->writer().submit_once(
        once,
        [](Stores&) -> Result<StoredAnswer> {
          return Error{ErrorCode::FieldInvalid, "no"};
        },
        [&](Result<StoredAnswer> answer) { promise.set_value(std::move(answer)); });
    return promise.get_future().get();
  };
  CHECK(refuse(request("k")).error().code == ErrorCode::FieldInvalid);
  CHECK_FALSE(post_once(fixture, request("k", "other"))->replayed);
}

TEST_CASE("a hundred parallel requests with one key store one row") {
  Fixture fixture;
  std::vector<std::thread> threads;
  std::atomic<int> created = 0;
  std::atomic<int> in_progress = 0;
  threads.reserve(100);
  for (int i = 0; i < 100; ++i) {
    threads.emplace_back([&] {
      const auto answer = post_once(fixture, request("k"));
      if (answer) {
        ++created;
      } else if (answer.error().code == ErrorCode::IdempotencyInProgress) {
        ++in_progress;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(created + in_progress == 100);
  CHECK(created >= 1);
  CHECK(fixture.last_id() == 1);
}

TEST_CASE("a full disk refuses writes, answers reads, and is left behind when there is space") {
  Fixture fixture;
  fixture.database.reset();
  std::vector<std::string> reports;
  std::mutex mutex;
  fixture.options.health_changed = [&](const Health& health) {
    const std::lock_guard lock(mutex);
    reports.push_back(std::string(word(health.state)) + " " + health.reason);
  };
  fixture.open();
  REQUIRE(fixture.append(sample_row()).has_value());
  const std::vector<MeasurementRow> many(10'000, sample_row());
  {
    const FullDisk full(rlim_t{64} << 10);
    const auto refused = fixture.append(many);
    CHECK_MESSAGE(refused.error().code == ErrorCode::StorageUnavailable, refused.error().message);
    CHECK(fixture.append(many).has_error());
    CHECK(fixture.database->health().state == HealthState::WritesFailing);
    CHECK_FALSE(fixture.database->health().reason.empty());
    CHECK(fixture.last_id() == 1);
  }
  SUBCASE("the next write finds out") {
    CHECK(fixture.append(many).has_value());
    CHECK(fixture.last_id() == 10'001);
  }
  SUBCASE("the writer finds out by itself") {
    while (fixture.database->health().state != HealthState::Ok) std::this_thread::yield();
    CHECK(fixture.last_id() == 1);
  }
  // Both failures and both ends of them are one report each.
  fixture.database.reset();
  REQUIRE(reports.size() == 2);
  CHECK_MESSAGE(reports[0].starts_with("writes_failing storage: disk I/O error (SQLite code 778"),
                reports[0]);
  CHECK_MESSAGE(reports[0].ends_with("errno 27: File too large)"), reports[0]);
  CHECK(reports[1] == "ok ");
}

TEST_CASE("a job that throws is reported once") {
  Fixture fixture;
  fixture.database.reset();
  std::string reported;
  fixture.options.job_threw = [&](const Error& bug) { reported += bug.message; };
  fixture.open();
  const auto outcome =
      fixture.write([](Stores&) -> Result<int> { throw std::logic_error("the writer's bug"); });
  CHECK(outcome.error().code == ErrorCode::Internal);
  const auto read = fixture.read(
      [](const Stores&) -> Result<int> { throw std::logic_error("the reader's bug"); });
  CHECK(read.error().code == ErrorCode::Internal);
  CHECK(reported == "a storage job failed: the writer's buga storage job failed: the reader's bug");
}

TEST_CASE("a writer that never rests indexes, and purges what has expired, all the same") {
  Fixture fixture;
  for (int i = 0; i < 300; ++i) REQUIRE(post_once(fixture, request(std::to_string(i))).has_value());
  fixture.clock.advance(std::chrono::hours(31 * 24));
  const auto count = [&](const char* sql) {
    sqlite::Connection reader(fixture.directory.file(), sqlite::Mode::Read);
    return reader.query_integer(sql);
  };
  // Two at a time, so that there is always a job waiting.
  const std::vector<MeasurementRow> rows(50, fixture.clock.row());
  std::vector<std::thread> gauges;
  std::atomic<bool> stop = false;
  for (int i = 0; i < 2; ++i) {
    gauges.emplace_back([&] {
      while (!stop) REQUIRE(fixture.append(rows).has_value());
    });
  }
  constexpr int kMostLooks = 12'000;
  int looks = 0;
  while (looks++ < kMostLooks && (count("SELECT count(*) FROM measurement_nodes") < 3 ||
                                  count("SELECT count(*) FROM idempotent_answers") > 0)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  stop = true;
  for (std::thread& gauge : gauges) gauge.join();
  CHECK(looks < kMostLooks);
}

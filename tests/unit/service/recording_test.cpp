#include <doctest/doctest.h>

#include <ctime>
#include <latch>

#include "record/record.hpp"
#include "service_fixture.hpp"
#include "support/comes_true.hpp"

using namespace fitgauge;
using namespace fitgauge::app;

namespace {

/// Writes down the ids it is given.
class RenderedIds final : public Rendering {
 public:
  /// @param taken gets them at the end.
  explicit RenderedIds(std::vector<std::int64_t>* taken = nullptr) : taken_(taken) {}
  void add(std::span<const Measurement> measurements, std::string_view) override {
    for (const Measurement& m : measurements) ids.push_back(m.id);
  }
  Answer finish() override {
    if (taken_ != nullptr) *taken_ = ids;
    return {.status = 201, .content_type = "", .location = "", .body = "stored"};
  }

  std::vector<std::int64_t> ids;

 private:
  std::vector<std::int64_t>* taken_;
};

IdempotencyScope scope(std::string_view body) {
  return {.caller = "", .method = "POST", .path = "/", .key = "k", .body = body};
}

std::int64_t stored(Service& service) {
  const auto report = service->verify().value();
  CHECK(report.findings.empty());
  return report.measurements;
}

/// What `work` returns on a thread for long bodies.
template <class Work>
auto long_request(Service& service, const Work& work) {
  std::promise<decltype(work())> promise;
  service->jobs().bulk.run(work,
                           [&](decltype(work()) made) { promise.set_value(std::move(made)); });
  return promise.get_future().get();
}

}  // namespace

TEST_CASE("a request is stored while it is read, in its order") {
  Service service;
  RenderedIds rendering;
  const auto answer = long_request(service, [&] {
    return service->measurements().record_while_reading(
        [](const MeasurementService::Take& take) -> Result<void> {
          for (std::int64_t piece = 0; piece < 20; ++piece) take(bores(100 * piece, 100));
          return {};
        },
        std::nullopt, rendering);
  });
  CHECK(answer.value().body == "stored");
  CHECK(stored(service) == 2000);
  REQUIRE(rendering.ids.size() == 2000);
  for (std::size_t i = 0; i < 2000; ++i) {
    CHECK(rendering.ids[i] == static_cast<std::int64_t>(i) + 1);
  }
  const auto last = wait_for<std::int64_t>([&](auto done) {
    service->measurements().find(
        {.number = 2000}, [](const Measurement& m) { CHECK(m.measured == bore(1999).measured); },
        std::move(done));
  });
  CHECK(last.has_value());
}

TEST_CASE("nothing is kept of a request that turns out to be wrong, or whose reading throws") {
  Service service;
  RenderedIds rendering;
  std::int64_t pieces = 10;
  bool throws = false;
  auto code = ErrorCode::RequestInvalid;
  SUBCASE("wrong") {}
  SUBCASE("wrong from the start") {
    pieces = 0;
    code = ErrorCode::JsonMalformed;
  }
  SUBCASE("throws") {
    throws = true;
    code = ErrorCode::Internal;
  }
  const auto answer = long_request(service, [&] {
    return service->measurements().record_while_reading(
        [&](const MeasurementService::Take& take) -> Result<void> {
          for (std::int64_t piece = 0; piece < pieces; ++piece) take(bores(0, 100));
          if (throws) throw std::bad_alloc();
          if (pieces == 0) return Error{ErrorCode::JsonMalformed, "no JSON"};
          return Error{ErrorCode::RequestInvalid, "the last row is bad"};
        },
        std::nullopt, rendering);
  });
  REQUIRE(answer.has_error());
  CHECK(answer.error().code == code);
  CHECK(stored(service) == 0);
}

TEST_CASE("a long request that throws is answered") {
  Service service;
  const auto answer =
      long_request(service, []() -> Result<Answer> { throw std::runtime_error("bug"); });
  CHECK(answer.error().code == ErrorCode::Internal);
}

TEST_CASE("the answer of a long request is kept under its key with its rows") {
  Service service;
  const auto post = [&](std::int64_t count) {
    return long_request(service, [&, count] {
      RenderedIds rendering;
      return service->measurements().record_while_reading(
          [count](const MeasurementService::Take& take) -> Result<void> {
            for (std::int64_t piece = 0; piece < count; ++piece) take(bores(0, 100));
            return {};
          },
          scope("body"), rendering);
    });
  };
  CHECK(post(3).value().body == "stored");
  CHECK(post(50).value().body == "stored");  // the writer does not even ask for the pieces
  CHECK(stored(service) == 300);
  const auto kept = wait_for<std::optional<Answer>>(
      [&](auto done) { service->measurements().find_answer(scope("body"), std::move(done)); });
  REQUIRE(kept.value().has_value());
  CHECK((*kept)->body == "stored");
}

TEST_CASE("who asks for a kept answer does not compute the digest of the body") {
  const auto time_of = [](const auto& work) {
    const auto used = [] {
      timespec time{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
      return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
    };
    const auto before = used();
    work();
    return used() - before;
  };
  Service service;
  const std::string body(std::size_t{64} << 20, 'x');
  const auto of_digest = time_of([&] { static_cast<void>(sha256(body)); });
  std::promise<bool> told;
  const auto of_asking = time_of([&] {
    service->measurements().find_answer(scope(body), [&told](const auto& kept) {
      told.set_value(kept.has_value() && !kept->has_value());
    });
  });
  CHECK(of_asking < of_digest / 2);
  CHECK(told.get_future().get());
}

TEST_CASE("small requests at once are all stored, each with the ids of its own rows") {
  constexpr int kThreads = 8;
  constexpr int kEach = 50;
  ApplicationOptions options;
  SUBCASE("many a commit") {}
  SUBCASE("a commit for each") { options.commit_each = true; }
  Service service(options);
  std::atomic<int> answered = 0;
  const auto client = [&](std::int64_t number) {
    for (int i = 0; i < kEach; ++i) {
      std::vector<std::int64_t> ids;
      const auto answer = wait_for<Answer>([&](auto done) {
        service->measurements().record(
            bores(number, 2), std::nullopt, [&ids] { return std::make_unique<RenderedIds>(&ids); },
            std::move(done));
      });
      if (!answer || ids.size() != 2 || ids[1] != ids[0] + 1) continue;
      const auto found = wait_for<std::int64_t>([&](auto done) {
        service->measurements().find(
            {.number = ids[0]},
            [&](const Measurement& m) {
              if (m.measured == bore(number).measured) ++answered;
            },
            std::move(done));
      });
      if (!found) --answered;
    }
  };
  std::vector<std::jthread> clients;
  clients.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) clients.emplace_back(client, i);
  clients.clear();
  CHECK(answered == kThreads * kEach);
  CHECK(stored(service) == 2 * kThreads * kEach);
}

TEST_CASE("a request that hits a bug is refused, those stored with it are not") {
  Service service;
  std::latch together(3);
  std::atomic<int> refused = 0;
  std::atomic<int> accepted = 0;
  const auto client = [&](bool is_wrong) {
    std::vector<Measurement> measurements = bores(0, 1);
    // A verdict that its limits do not give, which the database refuses.
    if (is_wrong) measurements.front().measured = Length::millimetres(26);
    together.arrive_and_wait();
    const auto answer = wait_for<Answer>([&](auto done) {
      service->measurements().record(
          std::move(measurements), std::nullopt, [] { return std::make_unique<RenderedIds>(); },
          std::move(done));
    });
    ++(answer ? accepted : refused);
    if (!answer) CHECK(answer.error().code == ErrorCode::Internal);
  };
  {
    std::vector<std::jthread> clients;
    for (const bool is_wrong : {false, true, false}) clients.emplace_back(client, is_wrong);
  }
  CHECK(refused == 1);
  CHECK(accepted == 2);
  CHECK(stored(service) == 2);
}

TEST_CASE("one request more than may wait is refused at once") {
  ApplicationOptions options;
  options.queue_limit = 4;
  Service service(options);
  std::promise<void> release;
  std::promise<void> held;
  std::atomic<int> refused = 0;
  std::atomic<int> accepted = 0;
  const auto post = [&](MeasurementService::Render render) {
    service->measurements().record(bores(0, 1), std::nullopt, std::move(render),
                                   [&](const Result<Answer>& answer) {
                                     ++(answer ? accepted : refused);
                                     if (!answer)
                                       CHECK(answer.error().code == ErrorCode::StorageBusy);
                                   });
  };
  post([&] {
    held.set_value();
    release.get_future().wait();
    return std::make_unique<RenderedIds>();
  });
  held.get_future().wait();
  for (int i = 0; i < 6; ++i) post([] { return std::make_unique<RenderedIds>(); });
  CHECK(refused == 2);
  release.set_value();
  CHECK(comes_true([&] { return accepted == 5; }));
  CHECK(stored(service) == 5);
}

TEST_CASE("requests that wait together get their own records, in more jobs than one") {
  /// Compares the records with those of its measurements, each written by itself.
  class Compared final : public Rendering {
   public:
    void add(std::span<const Measurement> measurements, std::string_view records) override {
      std::string apart;
      for (const Measurement& m : measurements) {
        if (!apart.empty()) apart += ',';
        append_record(apart, m);
      }
      CHECK(records == apart);
    }
    Answer finish() override {
      return {.status = 201, .content_type = "", .location = "", .body = ""};
    }
  };
  Service service;
  std::promise<void> release;
  std::promise<void> held;
  std::atomic<int> accepted = 0;
  const auto post = [&](std::int64_t first, std::int64_t count, MeasurementService::Render render) {
    service->measurements().record(
        bores(first, count), std::nullopt, std::move(render),
        [&](const Result<Answer>& answer) { accepted += answer ? 1 : 0; });
  };
  post(0, 1, [&] {
    held.set_value();
    release.get_future().wait();
    return std::make_unique<Compared>();
  });
  held.get_future().wait();
  for (std::int64_t count = 1; count <= 40; ++count) {
    post(100 * count, count, [] { return std::make_unique<Compared>(); });
  }
  release.set_value();
  CHECK(comes_true([&] { return accepted == 41; }));
  CHECK(stored(service) == 1 + 40 * 41 / 2);
}

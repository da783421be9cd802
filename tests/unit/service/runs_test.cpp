#include <latch>

#include "nc/program/program_cache.hpp"
#include "service/runs/active_run.hpp"
#include "service_fixture.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

constexpr std::string_view kForever = "LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1";

RunOrder endless() {
  RunOrder order = Service::order();
  order.options.limits.blocks = 100'000'000;
  order.options.limits.time = std::chrono::seconds(60);
  return order;
}

TEST_CASE("a run leaves its report and its trace") {
  Service service;
  service.program("TOOL CALL 30 Z\nL X+10 FMAX");
  const RunReport report = service.run(Service::order());
  CHECK(report.result.status == RunStatus::Completed);
  CHECK(report.finished_at.nanoseconds >= report.created_at.nanoseconds);

  const StoredRun stored = wait_for<StoredRun>([&](auto done) {
                             service->runs().find(report.id, std::move(done));
                           }).value();
  CHECK(stored.status == RunState::Completed);
  CHECK(stored.program == "TNC:\\main.h");
  CHECK(stored.request == "{}");
  auto trace =
      wait_for<TraceReader>([&](auto done) { service->runs().trace(report.id, std::move(done)); });
  CHECK(trace->next().value() == "a move, the end");
  CHECK(trace->next().value().empty());
}

TEST_CASE("a measuring cycle leaves a record of the simulation") {
  Service service;
  service.program(
      "TOOL CALL 30 Z\nTCH PROBE 427 MEASURE COORDINATE ~\n Q263=+0 ~\n Q264=+0 ~\n Q261=+0 ~\n"
      " Q320=+0 ~\n Q272=+3 ~\n Q267=-1 ~\n Q260=+50 ~\n Q281=+0 ~\n Q288=+0.1 ~\n Q289=-0.1 ~\n"
      " Q309=+0 ~\n Q330=+0");
  RunOrder order = Service::order();
  order.setup.features = {machine::Plane{{0, 0, 0.05}, {0, 0, 1}}};
  order.subject = {.part_id = "SN-17", .order = "WO-9"};
  const RunReport report = service.run(std::move(order));
  REQUIRE(report.result.status == RunStatus::Completed);
  const auto records = measurements_of(report, "test");
  REQUIRE(records.size() == 1);
  CHECK(records[0].source == Source::Simulation);
  CHECK(records[0].cycle == 427);
  CHECK(records[0].run_id == report.id);
  CHECK(records[0].part_id == "SN-17");
  CHECK(records[0].order == "WO-9");
  CHECK(records[0].measured == Length::micrometres(50));
  CHECK(records[0].result.verdict == gauging::Verdict::Good);
}

TEST_CASE("each judged value of a cycle leaves a record, and nothing unjudged is good") {
  Service service;
  const std::string hole =
      "TOOL CALL 30 Z\nTCH PROBE 421 MEASURE HOLE ~\n Q273=+50 ~\n"
      " Q274=+50 ~\n Q262=+25 ~\n Q325=+0 ~\n Q247=+90 ~\n Q261=-10 ~\n"
      " Q320=+0 ~\n Q260=+50 ~\n Q281=+0 ~\n";
  service.program(hole + " Q275=+25.01 ~\n Q276=+24.99 ~\n Q279=+0.1 ~\n Q280=+0.1\n" +
                  hole.substr(15) +
                  " Q275=+0 ~\n Q276=+0 ~\n Q279=+0 ~\n Q280=+0\n"
                  "TCH PROBE 420 MEASURE ANGLE ~\n Q263=+0 ~\n Q264=+60 ~\n Q265=+0 ~\n"
                  " Q266=+80 ~\n Q272=+1 ~\n Q267=+1 ~\n Q261=-10 ~\n Q320=+0 ~\n"
                  " Q260=+50 ~\n Q281=+0");
  RunOrder order = Service::order();
  order.setup.features = {machine::Block{{0, 0, -60}, {100, 100, 0}},
                          machine::Bore{{50.2, 50}, 0, 40, 25}};
  const RunReport report = service.run(std::move(order));
  REQUIRE(report.result.status == RunStatus::Completed);
  const auto records = measurements_of(report, std::nullopt);
  REQUIRE(records.size() == 5);
  using gauging::Verdict;
  const std::array verdicts{Verdict::Good, Verdict::Reject, Verdict::Good, Verdict::Unjudged,
                            Verdict::Unjudged};
  const std::array names{"Diameter", "Centre, main axis", "Centre, secondary axis", "Diameter",
                         "1st point"};
  for (std::size_t k = 0; k < records.size(); ++k) {
    CAPTURE(k);
    CHECK(records[k].result.verdict == verdicts[k]);
    CHECK(records[k].characteristic == names[k]);
  }
}

TEST_CASE("each side of a rectangle without limits leaves a record") {
  Service service;
  service.program(
      "TOOL CALL 30 Z\nTCH PROBE 424 MEAS. RECTAN. OUTS. ~\n Q273=+50 ~\n Q274=+50 ~\n"
      " Q282=+40 ~\n Q283=+20 ~\n Q261=-10 ~\n Q320=+2 ~\n Q260=+50 ~\n Q301=+1 ~\n"
      " Q284=+0 ~\n Q285=+0 ~\n Q286=+0 ~\n Q287=+0 ~\n Q279=+0 ~\n Q280=+0 ~\n Q281=+0");
  RunOrder order = Service::order();
  order.setup.features = {machine::Block{{29.99, 40, -60}, {70, 60, 0}}};
  const RunReport report = service.run(std::move(order));
  REQUIRE(report.result.status == RunStatus::Completed);
  const auto records = measurements_of(report, std::nullopt);
  REQUIRE(records.size() == 2);
  CHECK(records[0].measured == Length::micrometres(40'010));
  CHECK(records[1].measured == Length::micrometres(20'000));
}

TEST_CASE("a run is cancelled while it goes on and while it waits, each with its own setup") {
  Service service;
  service.program(kForever);
  RunOrder waiting = endless();
  waiting.setup.seed = 77;
  const auto first = service.start(endless()).value();
  const auto second = service.start(std::move(waiting)).value();
  const auto unfinished = wait_for<TraceReader>(
      [&](auto done) { service->runs().trace(second->id(), std::move(done)); });
  CHECK(unfinished.error().code == ErrorCode::RunUnfinished);

  service->runs().cancel(second);
  const RunReport queued = service.report_of(*second);
  CHECK(queued.result.status == RunStatus::Cancelled);
  CHECK(queued.result.messages.back().kind == MessageKind::Cancelled);
  CHECK(queued.seed == 77);
  CHECK(second->news(0).state == RunState::Cancelled);

  service->runs().cancel(first);
  CHECK(service.report_of(*first).result.status == RunStatus::Cancelled);
  service->runs().cancel(first);  // is over: nothing happens
}

TEST_CASE("what is beyond the queue is refused, and a stopping service takes nothing") {
  Service service;
  service.program(kForever);
  std::vector<std::shared_ptr<ActiveRun>> runs;
  while (true) {
    auto started = service.start(endless());
    if (!started) {
      CHECK(started.error().code == ErrorCode::Overloaded);
      break;
    }
    runs.push_back(*std::move(started));
  }
  CHECK(runs.size() == 65);
  service->jobs().call_off();
  service->runs().stop();
  for (const auto& run : runs) {
    CHECK(service.report_of(*run).result.status == RunStatus::Cancelled);
  }
  CHECK(service.start(endless()).error().code == ErrorCode::ShuttingDown);
}

TEST_CASE("figures that keep every thread and place hold up no run; orders that do so would") {
  Service service;
  service.program("Q1 = 1");
  std::promise<void> let_go;
  const auto fill = [wait = let_go.get_future().share()](JobPool& pool, int threads) {
    const auto idle = std::make_shared<std::latch>(threads);
    for (int i = 0; i < threads; ++i) {
      pool.run([idle,
                wait]() -> Result<void> { return idle->count_down(), wait.wait(), Result<void>(); },
               [](const Result<void>&) {});
    }
    idle->wait();  // else a thread takes a job from the full queue later
    const auto is_full = std::make_shared<std::atomic<bool>>(false);
    while (!*is_full) {
      pool.run([wait]() -> Result<void> { return wait.wait(), Result<void>(); },
               [is_full](const Result<void>& made) {
                 if (!made) *is_full = true;
               });
    }
  };
  fill(service->jobs().figures, 4);
  CHECK(service.run(Service::order()).result.status == RunStatus::Completed);
  fill(service->jobs().orders, 2);
  CHECK(service.start(Service::order()).error().code == ErrorCode::Overloaded);
  let_go.set_value();
}

TEST_CASE("runs that are accepted run, however many were cancelled before") {
  Service service;
  service.program(kForever);
  service.upload("TNC:\\short.h", "BEGIN PGM short MM\nQ1 = 1\nEND PGM short MM\n");
  const auto first = service.start(endless()).value();
  for (int round = 0; round < 3; ++round) {
    std::vector<std::shared_ptr<ActiveRun>> cancelled;
    for (int i = 0; i < 64; ++i) cancelled.push_back(service.start(endless()).value());
    CHECK(service.start(endless()).error().code == ErrorCode::Overloaded);
    for (const auto& run : cancelled) service->runs().cancel(run);
    for (const auto& run : cancelled) {
      CHECK(service.report_of(*run).result.status == RunStatus::Cancelled);
    }
  }
  std::vector<std::shared_ptr<ActiveRun>> accepted;
  for (int i = 0; i < 6; ++i) {
    accepted.push_back(service.start(Service::order("TNC:\\short.h")).value());
  }
  service->runs().cancel(first);
  for (const auto& run : accepted) {
    CHECK(service.report_of(*run).result.status == RunStatus::Completed);
  }
}

TEST_CASE("a report that cannot be made ends the run, and the service goes on") {
  Service service;
  service.program("Q1 = 1");
  service.break_reports();
  const auto run = service.start(Service::order()).value();
  std::promise<Result<FinishedRun>> promise;
  run->on_end([](const Result<FinishedRun>&) { throw std::runtime_error("a follower's bug"); });
  run->on_end([&promise](const Result<FinishedRun>& end) { promise.set_value(end); });
  CHECK(promise.get_future().get().error().code == ErrorCode::Internal);
  while (service->runs().active(run->id())) std::this_thread::yield();
  CHECK(service.start(Service::order()).has_value());
}

TEST_CASE("a run whose end is stored is over for everybody, at once") {
  Service service;
  service.program("Q1 = 1");
  for (int i = 0; i < 100; ++i) {
    const auto run = service.start(Service::order()).value();
    const auto is_stored = [&] {
      return !wait_for<StoredRun>([&](auto done) {
                service->runs().find(run->id(), std::move(done));
              })->result.empty();
    };
    while (!is_stored()) std::this_thread::yield();
    REQUIRE(service->runs().active(run->id()) == nullptr);
    const auto followed = wait_for<RunService::Followed>(
        [&](auto done) { service->runs().follow(run->id(), std::move(done)); });
    REQUIRE(followed->active == nullptr);
  }
}

TEST_CASE("a program that is gone when its turn comes fails with a message") {
  Service service;
  const RunReport report = service.run(Service::order("TNC:\\gone.h"));
  CHECK(report.result.status == RunStatus::Failed);
  CHECK(report.result.messages.back().program == "TNC:\\gone.h");
}

}  // namespace
}  // namespace fitgauge::app

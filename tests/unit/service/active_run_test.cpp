#include "service/runs/active_run.hpp"

#include <doctest/doctest.h>

namespace fitgauge::app {
namespace {

std::shared_ptr<const RunOrder> order() {
  return std::make_shared<const RunOrder>(
      RunOrder{.program = interpreter::ControlPath::parse("TNC:\\a.h").value(),
               .setup = {},
               .options = {},
               .request = {}});
}

TEST_CASE("a follower is told once of what is new, and of nothing it has seen") {
  ActiveRun run(1, "5f0c9a3e77d21b40", order(), {});
  const std::uint64_t seen = run.news(0).version;
  int woken = 0;
  const auto ticket = run.await(seen, [&] { ++woken; });
  CHECK(ticket != 0);
  run.started();
  run.printed("A");
  CHECK(woken == 1);
  CHECK(run.await(seen, [&] { ++woken; }) == 0);
  CHECK(woken == 2);
  run.forget(run.await(run.news(0).version, [&] { ++woken; }));
  run.printed("B");
  CHECK(woken == 2);
  CHECK(run.news(0).lines == std::vector<std::string>{"A", "B"});
  CHECK(run.news(1).lines == std::vector<std::string>{"B"});
  CHECK(run.news(9).lines.empty());
}

TEST_CASE("the end is told to those who wait and to those who come later") {
  ActiveRun run(1, "5f0c9a3e77d21b40", order(), {});
  std::vector<std::string> reports;
  const auto note = [&](const Result<FinishedRun>& end) { reports.push_back(end->report); };
  run.on_end(note);
  run.progressed(12);
  CHECK(reports.empty());
  run.finished(FinishedRun{RunState::Stopped, "report"});
  run.on_end(note);
  CHECK(reports == std::vector<std::string>{"report", "report"});
  CHECK(run.news(0).state == RunState::Stopped);
  CHECK(run.news(0).blocks == 12);
}

TEST_CASE("a run is asked to stop") {
  ActiveRun run(1, "5f0c9a3e77d21b40", order(), {});
  CHECK_FALSE(run.stop_token().stop_requested());
  run.cancel();
  CHECK(run.stop_token().stop_requested());
}

TEST_CASE(
    "what a run has written stays in sight when it tells where it is, and is told when asked") {
  using namespace std::chrono_literals;
  ActiveRun run(1, "5f0c9a3e77d21b40", order(), {});
  const auto files = std::make_shared<const std::vector<interpreter::WrittenFile>>();
  const auto newer = std::make_shared<const std::vector<interpreter::WrittenFile>>();
  CHECK(run.look(Look::StateAndFiles, 0ms).files == nullptr);  // a busy machine: it comes later
  run.show({.block = 1, .files = files});
  CHECK(run.wanted() == Look::Nothing);
  // The files are asked for while the run, asked for its state alone, is about to tell that.
  CHECK(run.look(Look::State, 0ms).block == 1);
  CHECK(run.look(Look::StateAndFiles, 0ms).files == files);
  run.show({.block = 2});
  CHECK(run.wanted() == Look::StateAndFiles);
  CHECK(run.look(Look::State, 0ms).block == 2);
  CHECK(run.look(Look::StateAndFiles, 0ms).files == files);
  run.show({.block = 3, .files = newer});
  CHECK(run.wanted() == Look::Nothing);
  CHECK(run.look(Look::StateAndFiles, 0ms).files == newer);
}

TEST_CASE("the words of a state are read back") {
  for (const RunState state :
       {RunState::Queued, RunState::Running, RunState::Completed, RunState::Stopped,
        RunState::Failed, RunState::LimitExceeded, RunState::Cancelled}) {
    CHECK(run_state_from_word(word(state)) == state);
  }
  CHECK_FALSE(run_state_from_word("done"));
}

}  // namespace
}  // namespace fitgauge::app

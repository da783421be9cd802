#include "cli/measure_command.hpp"

#include <doctest/doctest.h>

#include "cli/local_files.hpp"
#include "support/files.hpp"

using namespace fitgauge::cli;

namespace {

MeasureState example() {
  return {.server = "http://127.0.0.1:8286",
          .session = "5e55",
          .stored = {.bytes = 1'000, .lines = 11, .sha256 = "abc"},
          .pending = CsvPosition{.bytes = 2'000, .lines = 21, .sha256 = "def"},
          .counts = {.good = 7, .rework = 2, .reject = 1, .indeterminate = 0}};
}

}  // namespace

TEST_CASE("a state comes back as it was written") {
  MeasureState state = example();
  CHECK(parse_state(format_state(state)) == state);
  state.pending.reset();
  state.complete = true;
  CHECK(parse_state(format_state(state)) == state);
}

TEST_CASE("members of a newer version are ignored, in the inner objects too") {
  std::string text;
  for (const char c : format_state(example())) {
    text += c;
    if (c == '{') text += R"("newer":{"x":1},)";
  }
  CHECK(parse_state(text) == example());
}

TEST_CASE("a text that is no state is refused") {
  for (const char* text : {"", "{}", "no", "{\"session\":\"x\",\"stored\":{\"bytes\":-1}}"}) {
    CHECK_FALSE(parse_state(text));
  }
}

TEST_CASE("a key names the session and all that was read") {
  const MeasureState state = example();
  CHECK(chunk_key(state, *state.pending) == "5e55-def");
  CHECK(chunk_key(state, *state.pending) != chunk_key(state, state.stored));
}

TEST_CASE("the journal gives the last state") {
  const fitgauge::TemporaryFolder folder;
  const std::string path = folder.path() / "new/of/input.state";
  MeasureState state = example();
  {
    auto journal = MeasureJournal::open(path);
    REQUIRE(journal.has_value());
    CHECK_FALSE(journal->state());
    REQUIRE(journal->append(state).has_value());
    state.complete = true;
    REQUIRE(journal->append(state).has_value());
  }
  auto journal = MeasureJournal::open(path);
  CHECK(journal->state() == state);
  REQUIRE(journal->clear().has_value());
  CHECK_FALSE(journal->state());
}

TEST_CASE("a line that was cut off by a power cut is as if it had not been begun") {
  const fitgauge::TemporaryFolder folder;
  const std::string path = folder.path() / "torn";
  MeasureState state = example();
  REQUIRE(MeasureJournal::open(path)->append(state).has_value());
  std::ofstream(path, std::ios::app) << "{\"server\":\"http://127.0";
  auto journal = MeasureJournal::open(path);
  CHECK(journal->state() == state);
  state.complete = true;
  REQUIRE(journal->append(state).has_value());
  CHECK(*read_file(path) == format_state(example()) + '\n' + format_state(state) + '\n');
}

TEST_CASE("two runs do not have one journal at the same time") {
  const fitgauge::TemporaryFolder folder;
  const auto first = MeasureJournal::open(folder.path() / "x");
  REQUIRE(first.has_value());
  CHECK(MeasureJournal::open(folder.path() / "x").error().exit_code == ExitCode::LocalFile);
}

TEST_CASE("another file is not taken for a journal") {
  const fitgauge::TemporaryFolder folder;
  std::ofstream(folder.path() / "notes") << "milk\n";
  CHECK(MeasureJournal::open(folder.path() / "notes").error().exit_code == ExitCode::LocalFile);
  CHECK(*read_file(folder.path() / "notes") == "milk\n");
}

TEST_CASE("an input has one journal for each service") {
  setenv("XDG_STATE_HOME", "/state", 1);
  const std::string path = *journal_path("night.csv", "http://a");
  CHECK(path.starts_with("/state/fitgauge/"));
  CHECK(path == *journal_path("./night.csv", "http://a"));
  CHECK(path != *journal_path("night.csv", "http://b"));
  CHECK(path != *journal_path("day.csv", "http://a"));
}

TEST_CASE("the worst verdict is the one that costs most") {
  CHECK(worst_verdict({.good = 5}) == ExitCode::Good);
  CHECK(worst_verdict({.good = 5, .indeterminate = 1}) == ExitCode::Indeterminate);
  CHECK(worst_verdict({.good = 5, .rework = 1, .indeterminate = 1}) == ExitCode::Rework);
  CHECK(worst_verdict({.good = 5, .rework = 1, .reject = 1}) == ExitCode::Reject);
}

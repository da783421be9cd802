#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

TEST_CASE("an endless loop ends at the budget of blocks, exactly") {
  Control control;
  control.options.limits.blocks = 10'007;
  const RunResult result = control.run("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1");
  CHECK(result.status == RunStatus::LimitExceeded);
  CHECK(result.messages.back().kind == MessageKind::Limit);
  CHECK(result.messages.back().line == 3);
  CHECK(result.blocks_executed <= 10'007);
  CHECK(result.blocks_executed >= 10'005);
}

TEST_CASE("a program of as many blocks as the budget completes") {
  Control control;
  control.options.limits.blocks = 4;
  CHECK(control.run("Q1 = 1\nQ2 = 2").status == RunStatus::Completed);
  control.options.limits.blocks = 3;
  CHECK(control.run("Q1 = 1\nQ2 = 2").status == RunStatus::LimitExceeded);
}

TEST_CASE("an endless loop ends at the budget of time") {
  Control control;
  control.options.limits.blocks = UINT32_MAX;
  control.options.limits.time = std::chrono::milliseconds(20);
  CHECK(outcome(control.run("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1")) ==
        "limit_exceeded line 3: the run has taken its limit of 0.02 seconds");
  CHECK(control.run("LBL 1\nL X+1 FMAX\nL X+0 FMAX\nFN 9: IF +1 EQU +1 GOTO LBL 1").status ==
        RunStatus::LimitExceeded);
}

TEST_CASE("a run is cancelled from outside") {
  Control control;
  control.program("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1");
  std::stop_source source;
  source.request_stop();
  const RunResult result = control.run(source.get_token());
  CHECK(result.status == RunStatus::Cancelled);
  CHECK(result.messages.back().kind == MessageKind::Cancelled);
}

TEST_CASE("output is bounded: screen, files, messages") {
  Control control;
  control.file("m.a", "\"a line of some length %S\", QS1;\n");
  control.options.limits.output_bytes = 5000;
  for (const char* target : {"SCREEN:", "TNC:\\out.txt"}) {
    const RunResult result = control.run("QS1 = \"x\"\nLBL 1\nFN 16: F-PRINT m.a / " +
                                         std::string(target) + "\nFN 9: IF +1 EQU +1 GOTO LBL 1");
    CHECK(outcome(result) == "limit_exceeded line 4: the run has written more than 5000 bytes");
  }
  CHECK(control.run("LBL 1\nSTOP\nFN 9: IF +1 EQU +1 GOTO LBL 1").status ==
        RunStatus::LimitExceeded);
}

TEST_CASE("the number of files is bounded") {
  Control control;
  control.file("m.a", "\"x\";\nM_CLOSE\n");
  control.options.limits.files = 3;
  const RunResult result = control.run(
      "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQS1 = \"f\" || TOCHAR( DAT+Q1 )\n"
      "FN 16: F-PRINT m.a / :'QS1'\nFN 9: IF +1 EQU +1 GOTO LBL 1");
  CHECK(outcome(result) == "limit_exceeded line 6: the run has written more than 3 files");
  CHECK(result.files.size() == 3);
}

TEST_CASE("memory of loaded files is bounded") {
  Control control;
  control.options.limits.memory_bytes = 1000;
  control.program(std::string(5000, ';'), "big.h");
  CHECK(outcome(control.run("CALL PGM big.h")) ==
        "limit_exceeded line 2: the run has loaded more than 1000 bytes of files");
}

TEST_CASE("a repeat of very many times is counted, not stored") {
  Control control;
  control.options.limits.blocks = 1000;
  CHECK(control.run("LBL 1\nCALL LBL 1 REP 65534").status == RunStatus::LimitExceeded);
}

}  // namespace
}  // namespace fitgauge::interpreter

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

TEST_CASE("additions in one step with what follows are counted and refused one by one") {
  Control control;
  const std::string loop =
      "Q1 = 0\nQ2 = 0\nLBL 1\nQ2 = Q2 + Q1\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +5 GOTO LBL 1";
  const RunResult all = control.run(loop);
  check_values(all, "Q1=5, Q2=10");
  CHECK(all.blocks_executed == 24);
  // At every limit the values are those of the blocks before it: three, then LBL 1, the sum, the
  // counter and the jump of each pass.
  for (unsigned limit = 3; limit < 24; ++limit) {
    CAPTURE(limit);
    control.options.limits.blocks = limit;
    const RunResult result = control.run(loop);
    CHECK(result.status == RunStatus::LimitExceeded);
    CHECK(result.blocks_executed <= limit);
    CHECK(result.blocks_executed + 1 >= limit);  // a label counts with the block behind it
    double q1 = 0;
    double q2 = 0;
    for (unsigned block = 3; block < limit; ++block) {
      if ((block - 3) % 4 == 1) q2 += q1;
      if ((block - 3) % 4 == 2) q1 += 1;
    }
    CHECK(number_of(result, "Q1") == q1);
    CHECK(number_of(result, "Q2") == q2);
  }
  control.options.limits.blocks = 1'000'000;
  // A jump to the second and third of them.
  CHECK(value(control.run("Q1 = 1\nFN 9: IF +1 EQU +1 GOTO LBL 2\nQ1 = Q1 + 10\nLBL 2\n"
                          "Q1 = Q1 + 100\nLBL 3\nFN 12: IF +Q1 LT +5 GOTO LBL 3"),
              "Q1") == "101");
  // What fails is the block that fails.
  CHECK(outcome(
            control.run("Q1 = 1\nQ1 = Q1 + 1\nQ2 = Q9 + 1\nFN 12: IF +Q1 LT +0 GOTO LBL 1\nLBL 1"))
            .starts_with("failed line 4: "));
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
  // At the label or at the jump: the clock decides.
  const std::string ended = outcome(control.run("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1"));
  CHECK(ended.starts_with("limit_exceeded line "));
  CHECK(ended.ends_with(": the run has taken its limit of 0.02 seconds"));
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

constexpr const char* kEndless = "\nFN 9: IF +1 EQU +1 GOTO LBL 1";

/// A machine with a bore of many lobes in a plane at Z0, and a move inside that lasts.
constexpr const char* kLongMove =
    "TOOL CALL 30 Z\nCC X+0 Y+0\nL X+4 FMAX\nL Z-1 FMAX\nCP IPA+999999 IZ-5 DR+ FMAX";
void put_on_lobes(Control& control) {
  for (const auto axis : {machine::Axis::X, machine::Axis::Y, machine::Axis::Z}) {
    control.setup.machine.axes[machine::index(axis)]->min = -1e6;
    control.setup.machine.axes[machine::index(axis)]->max = 1e6;
  }
  control.setup.machine.start[machine::Axis::Z] = 500;
  machine::Bore bore;
  bore.diameter = 20;
  bore.depth = 50;
  bore.lobes = 1000;
  bore.lobe_amplitude_um = 100;
  control.setup.features = {machine::Plane{}, bore};
}

TEST_CASE("whatever a run holds counts as its memory") {
  struct Row {
    const char* what;
    std::string body;
  };
  const Row rows[] = {
      {"a program it calls", "CALL PGM big.h"},
      {"a table", "FN 26: TABOPEN big.tab"},
      {"a mask", "FN 16: F-PRINT big.a / SCREEN:"},
      {"presets", std::string("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\n"
                              "FN 17: SYSWRITE ID503 NRQ1 IDX1 = Q1") +
                      kEndless},
      {"files that are still to be written",
       std::string("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQS1 = \"f\" || TOCHAR( DAT+Q1 )\n"
                   "FN 16: F-PRINT empty.a / :'QS1'") +
           kEndless},
  };
  Control control;
  std::string table = "BEGIN T .TAB MM\nNR   X\n";
  std::string mask;
  for (int i = 0; i < 30'000; ++i) {
    table += fmt::format("{:<5}{}\n", i, i);
    mask += "L_ALL\n";
  }
  control.file("big.tab", table + "[END]\n");
  control.file("big.a", mask);
  control.file("empty.a", "\"\";\n");
  std::string program;
  for (int i = 0; i < 40'000; ++i) program += "Q1 = Q1 * 2\n";
  control.program(program, "big.h");
  control.options.limits.memory_bytes = 600'000;
  control.options.limits.files = 1'000'000;
  for (const Row& row : rows) {
    CAPTURE(row.what);
    CHECK(outcome(control.run(row.body)).find("has taken more than its 600000 bytes of memory") !=
          std::string::npos);
  }
}

TEST_CASE("a file that is not written yet counts") {
  Control control;
  control.file("empty.a", "");
  control.options.limits.files = 3;
  CHECK(outcome(control.run("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQS1 = \"f\" || TOCHAR( DAT+Q1 )\n"
                            "FN 16: F-PRINT empty.a / :'QS1'\nFN 9: IF +1 EQU +1 GOTO LBL 1")) ==
        "limit_exceeded line 6: the run has written more than 3 files");
}

TEST_CASE("empty lines on their way to a file count as output") {
  Control control;
  control.options.limits.output_bytes = 7000;
  std::string mask;
  for (int i = 0; i < 3000; ++i) mask += "\"\";\n";
  control.file("m.a", mask);
  CHECK(control.run("FN 16: F-PRINT m.a / TNC:\\out.txt").status == RunStatus::Completed);
  CHECK(control.run("FN 16: F-PRINT m.a / TNC:\\out.txt\nFN 16: F-PRINT m.a / TNC:\\out.txt")
            .status == RunStatus::LimitExceeded);
}

TEST_CASE("a block that lasts ends at the limit of time, wherever it stands") {
  struct Row {
    const char* what;
    std::string body;
  };
  const Row rows[] = {
      // As slow as a trace can be: an arc of thousands of turns around a bore of many lobes.
      {"a helix inside of lobes", kLongMove},
      {"existence of a file, again and again",
       std::string("QS1 = \"big.bin\"\nLBL 1\nFN 18: SYSREAD Q1 = ID10 NR110 IDX1") + kEndless},
      {"a comparison of texts",
       std::string("QS1 = \"a\"\nLBL 1\nFN 9: IF QS1 EQU QS1 GOTO LBL 1") + kEndless},
  };
  Control control;
  put_on_lobes(control);
  control.file("big.bin", std::string(1 << 20, 'x'));
  control.options.limits.blocks = UINT32_MAX;
  control.options.limits.time = std::chrono::hours(1);
  control.spent_at = {200, Allowance::Spent::Time};
  for (const Row& row : rows) {
    CAPTURE(row.what);
    const RunResult result = control.run(row.body);
    CHECK(outcome(result).find("the run has taken its limit of 3600 seconds") != std::string::npos);
  }
}

TEST_CASE("a move that has begun is called off from outside") {
  Control control;
  put_on_lobes(control);
  control.options.limits.time = std::chrono::hours(1);
  control.spent_at = {200, Allowance::Spent::Stop};
  const RunResult result = control.run(kLongMove);
  REQUIRE(result.status == RunStatus::Cancelled);
  CHECK(result.messages.back().line == 6);
}

TEST_CASE("the machining time stays a finite number") {
  Control control;
  control.options.parameters = {{{klartext::QSpace::Q, 1}, 1e-320}};
  for (const char* body :
       {"TOOL CALL 30 Z\nL X+100 FQ1", "TOOL CALL 30 Z\nL X+1 F1\nL X+100 FQ1"}) {
    const RunResult result = control.run(body);
    CHECK(std::isfinite(result.machining_time_s));
    for (const machine::TracedMove& move : control.traced) {
      CHECK(std::isfinite(move.seconds));
    }
  }
}

TEST_CASE("a repeat of very many times is counted, not stored") {
  Control control;
  control.options.limits.blocks = 1000;
  CHECK(control.run("LBL 1\nCALL LBL 1 REP 65534").status == RunStatus::LimitExceeded);
}

}  // namespace
}  // namespace fitgauge::interpreter

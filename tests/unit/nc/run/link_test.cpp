#include "nc/program/program_cache.hpp"

#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::DiagnosticCode;
using klartext::Severity;

TEST_CASE("all findings of all named programs are reported at once, each file once") {
  Control control;
  control.program("CALL PGM sub.h\nCALL PGM SUB\nCALL PGM none.h\nFN 9: IF +1 EQU +1 GOTO LBL 3");
  control.program("CALL LBL 7\nCALL PGM main.h\nTCH PROBE 999 OEM ~\n  Q1=+1\nL X+1 FMAX M77",
                  "sub.h");
  std::string found;
  for (const auto& diagnostic : control.diagnostics()) {
    found += std::string(id(diagnostic.code)) + " " + diagnostic.program.substr(13) + ":" +
             std::to_string(diagnostic.range.begin.line) + "\n";
  }
  CHECK(found ==
        "label.unknown main.h:5\nfile.missing main.h:4\n"
        "label.unknown sub.h:2\ncycle.unknown sub.h:4\nm_function.unknown sub.h:6\n");
  control.program("CALL PGM sub.h\nCALL PGM none.h");
  const auto warnings = control.diagnostics();
  CHECK(warnings[0].code == DiagnosticCode::FileMissing);
  CHECK(warnings[0].severity == Severity::Warning);
  CHECK(has_errors(warnings));
}

TEST_CASE("a cycle in the wrong form or family is an error with the right one") {
  struct Case {
    std::string block;
    std::string message;
  };
  for (const auto& [block, message] :
       {Case{"CYCL DEF 421 X",
             "421 is a touch-probe cycle: write TCH PROBE 421 instead of CYCL DEF 421"},
        Case{"TCH PROBE 247 X",
             "247 is not a touch-probe cycle: write CYCL DEF 247 instead of TCH PROBE 247"},
        Case{"TCH PROBE 421.0 X", "cycle 421 is written without sub-lines: write TCH PROBE 421"},
        Case{"CYCL DEF 247.0 X", "cycle 247 is written without sub-lines: write CYCL DEF 247"},
        Case{"TCH PROBE 3 MEASURING ~\n Q5=1",
             "cycle 3 is written in sub-lines: write TCH PROBE 3.0"},
        Case{"CYCL DEF 7 NULL ~\n Q1=1", "cycle 7 is written in sub-lines: write CYCL DEF 7.0"}}) {
    Control control;
    control.program(block);
    const auto found = control.diagnostics();
    REQUIRE(found.size() == 1);
    CHECK(found[0].severity == Severity::Error);
    CHECK(found[0].message == message);
  }
}

TEST_CASE("a contour label that is missing is found before the run") {
  Control control;
  control.program("CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1 /2\nM30\nLBL 1\nLBL 0");
  const auto found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::Warning);
  CHECK(found[0].message ==
        "label 2 is not defined in this program: the cycle that mills the contour fails");
}

TEST_CASE("sub-lines of a cycle without the line .0, out of order, or left out, are found") {
  Control control;
  const auto found = [&](std::string_view blocks) {
    control.program(blocks);
    const auto diagnostics = control.diagnostics();
    if (diagnostics.empty()) return std::string();
    return (diagnostics[0].severity == Severity::Error ? "error " : "warning ") +
           diagnostics[0].message;
  };
  const std::string alone = "error CYCL incomplete: ";
  for (const std::string line :
       {"CYCL DEF 7.1 X+5", "CYCL DEF 8.1 X", "CYCL DEF 9.1 DWELL 1", "CYCL DEF 10.1 ROT+5",
        "CYCL DEF 11.1 SCL0.5", "CYCL DEF 12.1 PGM main.h", "CYCL DEF 19.1 A+5", "CYCL DEF 26.1 X2",
        "CYCL DEF 32.1 T0.1", "CYCL DEF 4.1 SET UP 2", "CYCL DEF 14.1 CONTOUR LABEL 1",
        "TCH PROBE 3.1 Q1"}) {
    const std::string name = line.substr(0, line.find('.'));
    const std::string written = line.substr(0, line.find('.') + 2);
    CHECK(found("LBL 1\n" + line) ==
          alone + written + " stands without " + name + ".0 directly before it");
  }
  CHECK(found("CYCL DEF 7.0 DATUM SHIFT\nL X+1 FMAX\nCYCL DEF 7.1 X+5") != "");
  CHECK(found("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 10.1 ROT+5") != "");
  CHECK(found("CYCL DEF 7.0 DATUM SHIFT\n; a comment\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 Y+5") == "");
  CHECK(found("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\nCYCL DEF 7.3 Z+5") ==
        "warning CYCL DEF 7.2 is missing before CYCL DEF 7.3");
  CHECK(found("CYCL DEF 10.0 ROTATION\nL X+1 FMAX") ==
        "warning CYCL DEF 10.1 is missing after CYCL DEF 10.0");
}

TEST_CASE("what two sub-lines of a cycle say twice, or against each other, is refused") {
  Control control;
  const auto found = [&](std::string_view blocks) { return control.first_finding(blocks); };
  const std::string shift = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 ";
  const std::string both = "cycle 7 takes a row of the datum table or coordinates, not both";
  CHECK(found(shift + "X+5\nCYCL DEF 7.2 X+6") == "X is also in line 3 of this cycle");
  CHECK(found(shift + "X+5\nCYCL DEF 7.2 Y+5\nCYCL DEF 7.3 X+6") ==
        "X is also in line 3 of this cycle");
  CHECK(found(shift + "#1 X+5") == both);
  CHECK(found(shift + "#1\nCYCL DEF 7.2 X+5") == both);
  CHECK(found(shift + "X+5\nCYCL DEF 7.2 Y+5\nCYCL DEF 7.3 Z+5") == "");
  CHECK(found("CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X\nCYCL DEF 8.2 X") ==
        "X is also in line 3 of this cycle");
  CHECK(found("CYCL DEF 26.0 AXIS\nCYCL DEF 26.1 X2\nCYCL DEF 26.2 X3") ==
        "X is also in line 3 of this cycle");
}

TEST_CASE("a blank whose corners contradict each other is found") {
  Control control;
  const auto found = [&](std::string_view blocks) {
    control.program(blocks);
    const auto diagnostics = control.diagnostics();
    if (diagnostics.empty()) return std::string();
    CHECK(diagnostics[0].severity == Severity::Warning);
    return diagnostics[0].message;
  };
  const std::string corner = "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 ";
  CHECK(found(corner + "X-10 Y+10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: X-10 and X+0");
  CHECK(found(corner + "X+10 Y+10 Z-20") ==
        "the upper corner of the blank must lie above the lower one: Z-20 and Z-20");
  CHECK(found("BLK FORM 0.2 X+10 Y+10 Z+0") ==
        "BLK FORM 0.2 stands without BLK FORM 0.1 before it");
  CHECK(found(corner + "X+10 Y+10 Z+0") == "");
  CHECK(found(corner + "IX+10 IY+10 IZ+0.1") == "");
  CHECK(found(corner + "X+10 IY-10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: Y-10 and Y+0");
  CHECK(found("BLK FORM 0.1 Z X+5 Y+0 Z-20\nBLK FORM 0.2 IX+0 Y+10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: X+5 and X+5");
  const std::string by_q = "BLK FORM 0.1 Z X+Q1 Y+0 Z-20\nBLK FORM 0.2 ";
  CHECK(found("Q1 = 50\n" + by_q + "X+20 Y+10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: X+20 and X+50");
  CHECK(found("Q1 = 5\n" + by_q + "X+Q1 Y+10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: X+5 and X+5");
  CHECK(found("Q1 = 5\n" + by_q + "X+20 Y+10 Z+0") == "");
  CHECK(found(by_q + "X+20 Y+10 Z+0") == "");
  CHECK(found("Q1 = 5\nBLK FORM 0.1 Z X+Q1 Y+0 Z-20\nQ1 = 30\nBLK FORM 0.2 X+Q1 Y+10 Z+0") == "");
  control.file("sub.h", "BEGIN PGM SUB MM\nBLK FORM 0.2 X+10 Y+10 Z+0\nEND PGM SUB MM\n");
  CHECK(found("BLK FORM 0.1 Z X+0 Y+0 Z-20\nCALL PGM sub.h") == "");
  CHECK(found("CALL PGM sub.h") == "BLK FORM 0.2 stands without BLK FORM 0.1 before it");
  control.file("between.h", "BEGIN PGM BETWEEN MM\nCALL PGM sub.h\nEND PGM BETWEEN MM\n");
  CHECK(found("BLK FORM 0.1 Z X+0 Y+0 Z-20\nCALL PGM between.h") == "");
  CHECK(found("CALL PGM between.h") == "BLK FORM 0.2 stands without BLK FORM 0.1 before it");
  CHECK(found("BLK FORM 0.1 Z IX+5 Y+0 Z-20\nBLK FORM 0.2 X+10 Y+10 Z+0") ==
        "the lower corner of the blank must be absolute: there is no position before it");
}

TEST_CASE("a run notes a blank whose corners contradict each other") {
  Control control;
  const auto noted = [&](std::string_view blocks) {
    std::string all;
    for (const RunMessage& message : control.run(blocks).messages) all += message.text + "\n";
    return all;
  };
  CHECK(noted("BLK FORM 0.1 Z IX+0 Y+0 Z-20\nBLK FORM 0.2 X+10 IY-10 Z+0") ==
        "the lower corner of the blank must be absolute: there is no position before it\n"
        "the upper corner of the blank must lie above the lower one: Y-10 and Y+0\n");
  CHECK(noted("BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+10 IY+10 Z+0") == "");
  CHECK(noted("Q1 = 50\nBLK FORM 0.1 Z X+Q1 Y+0 Z-20\nBLK FORM 0.2 X+20 Y+10 Z+0") ==
        "the upper corner of the blank must lie above the lower one: X+20 and X+50\n");
  CHECK(noted("Q1 = 5\nBLK FORM 0.1 Z X+Q1 Y+0 Z-20\nBLK FORM 0.2 X+20 Y+10 Z+0") == "");
  control.file("sub.h", "BEGIN PGM SUB MM\nBLK FORM 0.2 X+10 Y+10 Z+0\nEND PGM SUB MM\n");
  CHECK(noted("BLK FORM 0.1 Z X+0 Y+0 Z-20\nCALL PGM sub.h") == "");
  CHECK(noted("CALL PGM sub.h") == "BLK FORM 0.2 stands without BLK FORM 0.1 before it\n");
}

TEST_CASE("M functions of one block that exclude each other are found before the run") {
  Control control;
  const auto found = [&](std::string_view block) { return control.first_finding(block); };
  const std::string end = " exclude each other in a block: leave one of them out";
  CHECK(found("L X+1 F100 M3 M4") == "M3 and M4" + end);
  CHECK(found("M127 M126") == "M127 and M126" + end);
  CHECK(found("L X+1 F100 M128 M8 M129") == "M128 and M129" + end);
  CHECK(found("STOP M8 M8") == "M8 and M8" + end);
  // One applies at the begin of the block, the other at its end.
  CHECK(found("L X+1 F100 M3 M5").empty());
  CHECK(found("L X+1 F100 M8 M9").empty());
  CHECK(found("L X+1 F100 M3 M8 M91").empty());
}

TEST_CASE("a row and columns that the only open table lacks are found before the run") {
  Control control;
  control.file("t.tab", "BEGIN T .TAB\nNR X  Y\n12 +1 +2\n[END]\n");
  const auto found = [&](std::string_view blocks) { return control.first_finding(blocks); };
  const std::string open = "FN 26: TABOPEN t.tab\n";
  const std::string fails = ": the run fails when it reaches this block";
  CHECK(found(open + "FN 28: TABREAD Q1 = 12/\"X,Y\"").empty());
  CHECK(found(open + "FN 28: TABREAD Q1 = Q9/\"X, Y\"").empty());
  CHECK(found(open + "FN 28: TABREAD Q1 = 12/\"X,Z\"") == "table T .TAB has no column 'Z'" + fails);
  CHECK(found(open + "FN 28: TABREAD Q1 = Q9/\"Z\"") == "table T .TAB has no column 'Z'" + fails);
  CHECK(found(open + "FN 28: TABREAD Q1 = 13/\"X\"") ==
        "table T .TAB has no row 13 in its column NR" + fails);
  CHECK(
      found(open + "Q2 = 1\nFN 27: TABWRITE 13/\"X\" = Q2\nFN 28: TABREAD Q1 = 13/\"X\"").empty());
  CHECK(found(open + "FN 26: TABOPEN QS1\nFN 28: TABREAD Q1 = 13/\"X\"").empty());
  CHECK(found("FN 26: TABOPEN none.tab\nFN 28: TABREAD Q1 = 13/\"X\"")
            .starts_with("table 'none.tab' does not exist"));
}

TEST_CASE("cycle parameters are checked before the run") {
  Control control;
  const auto code_of = [&](std::string_view parameters) {
    control.program("TCH PROBE 427 MEASURE COORDINATE ~\n" + std::string(parameters) +
                    "\nTOOL CALL 0 Z");
    const auto found = control.diagnostics();
    return found.empty() ? std::string("fine") : std::string(id(found[0].code));
  };
  const std::string good =
      " Q263=+1 ~\n Q264=+1 ~\n Q261=-5 ~\n Q320=+0 ~\n Q272=+3 ~\n Q267=-1 ~\n Q260=+20 ~\n"
      " Q281=+0 ~\n Q288=+0 ~\n Q289=+0 ~\n Q309=+0 ~\n Q330=+0";
  CHECK(code_of(good) == "fine");
  CHECK(code_of(good + " ~\n Q999=+1") == "cycle.parameter_unknown");
  std::string bad = good;
  bad.replace(bad.find("Q272=+3"), 7, "Q272=+4");
  CHECK(code_of(bad) == "cycle.parameter_invalid");
  std::string text = good;
  text.replace(text.find("Q272=+3"), 7, "Q272=Q5");
  CHECK(code_of(text) == "fine");
  for (const char* word : {"AUTO", "MAX", "FU0.2", "FZ0.1"}) {
    std::string feed = good;
    feed.replace(feed.find("Q320=+0"), 7, std::string("Q320=") + word);
    CHECK(code_of(feed) == "cycle.parameter_invalid");
  }
  CHECK(code_of(" Q263=+1") == "cycle.parameter_invalid");
}

TEST_CASE("a finding lies within one physical line") {
  Control control;
  control.program("TCH PROBE 999 OEM ~\n  Q1=+1 ~\n  Q2=+2");
  const auto found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].range.begin.line == 2);
  CHECK(found[0].range.end.line == 2);
  CHECK(found[0].source == "TCH PROBE 999 OEM ~");
}

TEST_CASE("findings of a bad program are bounded") {
  std::string body;
  for (int i = 0; i < 1000; ++i) body += "CALL LBL 77\n";
  Control control;
  control.program(body);
  CHECK(control.diagnostics().size() == 200);
}

TEST_CASE("a program is linked once for each revision of its file") {
  Control control;
  control.program("Q1 = 1");
  const auto first = control.programs.get(*control.disk.find(Control::main_path()));
  CHECK(first == control.programs.get(*control.disk.find(Control::main_path())));
  control.program("Q1 = 2");
  CHECK(first != control.programs.get(*control.disk.find(Control::main_path())));
  CHECK(value(control.run(), "Q1") == "2");
}

TEST_CASE("a program at hand is not read from the disk again") {
  /// Counts how often bytes are read.
  struct CountingDisk final : ControlDisk {
    explicit CountingDisk(const MemoryDisk& disk) : inner(disk) {}
    std::optional<ControlFile> find(const ControlPath& path) const override {
      ++reads;
      return inner.find(path);
    }
    std::optional<std::string> revision(const ControlPath& path) const override {
      return inner.revision(path);
    }
    bool has_directory(std::string_view directory) const override {
      return inner.has_directory(directory);
    }
    const MemoryDisk& inner;
    mutable int reads = 0;
  };
  Control control;
  control.program("Q1 = 1");
  const CountingDisk disk(control.disk);
  const auto first = control.programs.get(disk, Control::main_path());
  REQUIRE(first != nullptr);
  CHECK(control.programs.get(disk, Control::main_path()) == first);
  CHECK(disk.reads == 1);
  control.program("Q1 = 2");
  CHECK(control.programs.get(disk, Control::main_path()) != first);
  CHECK(disk.reads == 2);
  CHECK(control.programs.get(disk, ControlPath::parse("TNC:\\none.h").value()) == nullptr);
}

TEST_CASE("a cache holds as many bytes as it may") {
  ProgramCache cache(1);
  Control control;
  control.program("Q1 = 1", "a.h");
  control.program("Q1 = 1", "b.h");
  const auto file = [&](const char* name) {
    return *control.disk.find(ControlPath::parse(std::string("TNC:\\nc_prog\\") + name).value());
  };
  const auto a = cache.get(file("a.h"));
  CHECK(a == cache.get(file("a.h")));
  cache.get(file("b.h"));
  CHECK(a != cache.get(file("a.h")));
}

TEST_CASE("one linked program runs on several threads at once") {
  Control control;
  control.program("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +1000 GOTO LBL 1");
  const auto file = control.programs.get(*control.disk.find(Control::main_path()));
  std::vector<RunResult> results(4);
  std::vector<std::jthread> threads;
  threads.reserve(results.size());
  for (RunResult& result : results) {
    threads.emplace_back([&] {
      machine::SimulatedMachine machine(control.setup);
      RunObserver observer;
      result = run(file->program,
                   {machine, control.disk, control.programs, control.clock, observer}, {});
    });
  }
  threads.clear();
  for (const RunResult& result : results) CHECK(value(result, "Q1") == "1000");
}

TEST_CASE("an observer sees the blocks that command, or all") {
  class Recorder final : public RunObserver {
   public:
    bool follows_every_block() const override { return every; }
    void entered(const Place& place) override { lines.push_back(place.line()); }
    bool every = false;
    std::vector<std::uint32_t> lines;
  };
  Control control;
  control.program("Q1 = 1\nM8\nQ2 = 2 + 3 * Q1\nLBL 1\nL X+1 FMAX");
  const auto file = control.programs.get(*control.disk.find(Control::main_path()));
  for (const bool every : {false, true}) {
    Recorder recorder;
    recorder.every = every;
    machine::SimulatedMachine machine(control.setup);
    run(file->program, {machine, control.disk, control.programs, control.clock, recorder}, {});
    CHECK(recorder.lines ==
          (every ? std::vector<std::uint32_t>{2, 3, 4, 6, 7} : std::vector<std::uint32_t>{3, 6}));
  }
}

}  // namespace
}  // namespace fitgauge::interpreter

#include "nc/program/diagnose.hpp"
#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

/// The value that `FN 18: SYSREAD` gives after `before` ran, or the outcome of a failed run.
std::string system_data(std::string_view address, std::string_view before = "Q1 = 0") {
  Control control;
  control.setup.features = {machine::Block{{-50, -50, -40}, {50, 50, 0}}};
  machine::ProbeRow& probe = control.setup.machine.probes[0].row;
  probe.distance = 17;
  probe.cal_of1 = 0.25;
  probe.cal_of2 = -0.5;
  probe.cal_ang = 90;
  const RunResult result =
      control.run(std::string(before) + "\nFN 18: SYSREAD Q5 = " + std::string(address));
  return result.status == RunStatus::Completed ? value(result, "Q5") : outcome(result);
}

TEST_CASE("FN 18 reads the state of the machine") {
  CHECK(system_data("ID10 NR1") == "0");
  CHECK(system_data("ID20 NR1") == "0");
  CHECK(system_data("ID20 NR3") == "-1");
  const char* probe = "TOOL CALL 30 Z S1200 F350 DL+0.5 DR+0.1\nM13";
  CHECK(system_data("ID20 NR1", probe) == "30");
  CHECK(system_data("ID20 NR3", probe) == "2");
  CHECK(system_data("ID20 NR4", probe) == "1200");
  CHECK(system_data("ID20 NR5", probe) == "0");
  CHECK(system_data("ID20 NR5", "TOOL CALL 30 Z S1\nM4\nM5") == "3");
  CHECK(system_data("ID20 NR8", probe) == "1");
  CHECK(system_data("ID20 NR9", probe) == "350");
  CHECK(system_data("ID50 NR1 IDX30") == "120");
  CHECK(system_data("ID50 NR2", probe) == "2");
  CHECK(system_data("ID50 NR7 IDX30") == "0");
  CHECK(system_data("ID60 NR4", probe) == "0.5");
  CHECK(system_data("ID200 NR1", probe) == "2.1");
  CHECK(system_data("ID200 NR2", probe) == "120.5");
  CHECK(system_data("ID230 NR2 IDX1") == "-500");
  CHECK(system_data("ID230 NR3 IDX3") == "500");
  CHECK(system_data("ID240 NR1 IDX3") == "500");
  CHECK(system_data("ID270 NR1 IDX3", probe) == "379.5");
  CHECK(system_data("ID280 NR1", "M128") == "-1");
  CHECK(system_data("ID320 NR1") == "1795161909");
  CHECK(system_data("ID350 NR11", "TOOL CALL 30 Z") == "2");
  CHECK(system_data("ID350 NR56 IDX1", "TOOL CALL 30 Z") == "17");
  CHECK(system_data("ID503 NR1 IDX1") == "0");
  CHECK(system_data("ID505 NR1") == "0");
}

TEST_CASE("FN 18 answers every number that the check takes for available") {
  const std::map<int, std::string> numbers{
      {10, " 1 3 6 8 103 110 111"},
      {20, " 1 2 3 4 5 8 9 11"},
      {50, " 1 2 3 4 5 6 7 8 9 10 11 13 14 15 16 17 18 19 20 21 22 24 25 26 28 32 33 36"},
      {60, " 1 2 3 4 5 6 7"},
      {200, " 1 2"},
      {210, " 1 2 3 4 5 6 7"},
      {220, " 2 3 4"},
      {230, " 2 3 5"},
      {240, " 1 8"},
      {270, " 1"},
      {280, " 1 2"},
      {310, " 116 128 144"},
      {320, " 1"},
      {350, " 10 11 12 14 15 20 21 50 51 52 53 54 55 56 57"},
      {360, " 1 2 3"},
      {505, " 1"},
      {990, " 6 16"}};
  for (int id = 0; id < 1000; ++id) {
    if (id == 500 || id == 502 || id == 503) continue;  // NR is a row
    CAPTURE(id);
    std::string found;
    const int end = has_system_data(id, std::nullopt, false) ? 1000 : 0;
    for (int number = 0; number < end; ++number) {
      if (!has_system_data(id, number, false)) continue;
      found += fmt::format(" {}", number);
      const std::string address = fmt::format("ID{} NR{} IDX{}", id, number,
                                              id == 50                    ? 30
                                              : id == 10                  ? 200
                                              : id == 350 && number == 50 ? 2
                                                                          : 1);
      const std::string answer = system_data(
          address,
          "QS200 = \"a.h\"\nTOOL CALL 30 Z S1000\nL Z+300 FMAX\nTCH PROBE 0.0 REF. PLANE Q7 Z-\n"
          "TCH PROBE 0.1 X+10 Y+10 Z+5\nCYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=100 Q202=5 "
          "Q203=0 Q204=50");
      CHECK_MESSAGE(answer.find("failed") == std::string::npos, address, ": ", answer);
    }
    CHECK(found == (numbers.contains(id) ? numbers.at(id) : ""));
  }
}

TEST_CASE("the check names system data that this control lacks") {
  const auto found = [](std::string_view block) { return Control().first_finding(block); };
  const std::string fails = " is not available here: the run fails when it reaches this block";
  CHECK(found("FN 18: SYSREAD Q1 = ID9999 NR1") == "FN 18: ID9999" + fails);
  CHECK(found("FN 18: SYSREAD Q1 = ID9999 NRQ3") == "FN 18: ID9999" + fails);
  CHECK(found("FN 18: SYSREAD Q1 = ID20 NR77 IDX1") == "FN 18: ID20 NR77" + fails);
  CHECK(found("FN 17: SYSWRITE ID20 NR1 = 5") == "FN 17: ID20" + fails);
  CHECK(found("FN 17: SYSWRITE ID50 NR24 IDX30 = 5") == "FN 17: ID50 NR24" + fails);
  CHECK(found("FN 17: SYSWRITE ID50 NR4 IDX30 = 5") == "");
  CHECK(found("FN 18: SYSREAD Q1 = ID503 NR7777 IDX1") == "");
  CHECK(found("FN 18: SYSREAD Q1 = ID210 NR5 IDX30") == "FN 18: ID210 NR5 IDX30" + fails);
  CHECK(found("FN 18: SYSREAD Q1 = ID210 NR5 IDX4") == "FN 18: ID210 NR5 IDX4" + fails);
  CHECK(found("FN 18: SYSREAD Q1 = ID210 NR5 IDXQ4") == "");
  CHECK(found("FN 18: SYSREAD Q1 = ID210 NR5") == "");
  CHECK(found("FN 18: SYSREAD Q1 = ID220 NR2 IDX30") == "FN 18: ID220 NR2 IDX30" + fails);
  CHECK(found("FN 18: SYSREAD Q1 = ID220 NR2 IDX6") == "");
  CHECK(found("FN 18: SYSREAD Q1 = ID10 NR103") == "FN 18: ID10 NR103" + fails);
  CHECK(found("QS0 = \"a.h\"\nFN 18: SYSREAD Q1 = ID10 NR110 IDX0") == "");
  CHECK(found("FN 18: SYSREAD Q1 = IDQ7 NR1") == "");
}

TEST_CASE("the check notes system data that the run refuses for want of a cycle, probe or text") {
  struct Case {
    std::string address;
    std::string need;
    std::string given;
  };
  const Case cases[] = {
      {"ID10 NR103 IDX201", "an active cycle", "CYCL DEF 200 DRILLING Q201=-5 Q206=100"},
      {"ID10 NR110 IDX5", "a text in QS5", "QS5 = \"a.h\""},
      {"ID10 NR111 IDX5", "a text in QS5", "QS5 = \"a\""},
      {"ID350 NR10", "a touch probe in the spindle", "TOOL CALL 30 Z"},
      {"ID360 NR1 IDX1", "a touch before it",
       "TOOL CALL 30 Z\nL Z+300 FMAX\nTCH PROBE 0.0 REF. PLANE Q7 Z-\nTCH PROBE 0.1 X+10 Y+10 Z+5"},
  };
  for (const auto& [address, need, given] : cases) {
    CAPTURE(address);
    const auto notes = [&](const std::string& before) {
      Control control;
      control.file("other.h", "BEGIN PGM OTHER MM\nEND PGM OTHER MM\n");
      control.program(before + "\nFN 18: SYSREAD Q1 = " + address);
      std::string all;
      for (const auto& each : control.diagnostics())
        if (each.message.starts_with("FN 18")) all += word(each.severity), all += each.message;
      return all;
    };
    CHECK(notes("Q1 = 0").starts_with("noteFN 18: " + address.substr(0, address.find(" IDX")) +
                                      " needs " + need + ", which nothing"));
    CHECK(notes(given) == "");
    CHECK(notes("CALL PGM other.h") == "");
    CHECK(system_data(address).starts_with("failed"));
    CHECK_FALSE(system_data(address, given).starts_with("failed"));
  }
}

TEST_CASE("a touch and the circle through points are read to a whole nanometre") {
  Control control;
  control.setup.features = {machine::Block{{0, -50, -40}, {90, 50, 0}}};
  const RunResult result = control.run(
      "TOOL CALL 30 Z\nL X-10 Y+10 Z-5 R0 FMAX\nTCH PROBE 0.0 REF. PLANE Q7 X+\nTCH PROBE 0.1 "
      "X-5.1 "
      "Y+10 Z-5\n"
      "FN 18: SYSREAD Q20 = ID360 NR1 IDX1\nQ30 = 0.3\nQ31 = 0.1\nQ32 = 0.1\nQ33 = 0.3\n"
      "Q34 = -0.1\nQ35 = 0.1\nFN 23: Q40 = CDATA Q30");
  CHECK(outcome(result) == "completed");
  CHECK(number_of(result, "Q20") == 0);
  CHECK(number_of(result, "Q40") == 0.1);
  CHECK(number_of(result, "Q41") == 0.1);
  CHECK(number_of(result, "Q42") == 0.2);
}

TEST_CASE("FN 17 writes every column of a tool that FN 18 reads") {
  for (const int nr : {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 13, 14,
                       15, 16, 17, 18, 19, 20, 21, 22, 28, 32, 33, 36}) {
    CAPTURE(nr);
    const std::string column = "ID50 NR" + std::to_string(nr) + " IDX30";
    const std::string was = system_data(column);
    const std::string written = was == "1" ? "0" : "1";
    CHECK(system_data(column, "FN 17: SYSWRITE " + column + " = " + written) == written);
  }
  CHECK(system_data("ID50 NR15 IDX30", "FN 17: SYSWRITE ID50 NR15 IDX30 = 2.5") ==
        "failed line 2: ID50 NR15 of tool 30: the column takes a whole number, and not 2.5");
  CHECK(system_data("ID50 NR8 IDX30", "FN 17: SYSWRITE ID50 NR8 IDX30 = -1") ==
        "failed line 2: ID50 NR8 of tool 30: the column takes a whole number, and not -1");
  CHECK(system_data("ID50 NR1 IDX30", "FN 17: SYSWRITE ID50 NR37 IDX30 = 1") ==
        "failed line 2: ID50 NR37 IDX30 is not available");
}

TEST_CASE("FN 18 reads the prepared tool, three M functions and the calibration of a probe") {
  CHECK(system_data("ID20 NR2") == "0");
  CHECK(system_data("ID20 NR2", "TOOL CALL 30 Z\nTOOL DEF 5") == "5");
  CHECK(system_data("ID20 NR2", "TOOL DEF 30\nTOOL CALL 30 Z") == "0");
  CHECK(system_data("ID310 NR116", "M116") == "-1");
  CHECK(system_data("ID310 NR116", "M116\nM117") == "0");
  CHECK(system_data("ID310 NR128", "M128") == "-1");
  CHECK(system_data("ID310 NR144", "M144") == "-1");
  CHECK(system_data("ID310 NR144", "M144\nM145") == "0");
  CHECK(system_data("ID310 NR1") == "failed line 3: ID310 NR1 is not available");
  CHECK(system_data("ID50 NR24 IDX30") == "0.25");
  CHECK(system_data("ID50 NR25 IDX30") == "-0.5");
  CHECK(system_data("ID50 NR26 IDX30") == "90");
  CHECK(system_data("ID50 NR26 IDX7") ==
        "failed line 3: Tool not defined: tool 7 is not in the tool table");
}

TEST_CASE("FN 18 tells which parameters the block of the active cycle gives") {
  const char* drilling = "CYCL DEF 200 DRILLING ~\n Q200=+2 ~\n Q201=-20";
  CHECK(system_data("ID10 NR103 IDX201", drilling) == "1");
  CHECK(system_data("ID10 NR103 IDX204", drilling) == "0");
  CHECK(system_data("ID10 NR103 IDX201") == "failed line 3: ID10 NR103 IDX201 is not available");
}

TEST_CASE("FN 18 reads transformations") {
  CHECK(system_data("ID220 NR2 IDX2", "TRANS DATUM AXIS Y+12.5") == "12.5");
  CHECK(system_data("ID210 NR2", "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+30") == "30");
  CHECK(system_data("ID210 NR3", "TRANS MIRROR AXIS X Z") == "5");
  CHECK(system_data("ID210 NR4 IDX2", "CYCL DEF 26.0 S\nCYCL DEF 26.1 X2 Y3 CCX+1 CCY+1") == "3");
}

TEST_CASE("an unknown system datum is an error, never 0") {
  CHECK(system_data("ID20 NR99") == "failed line 3: ID20 NR99 is not available");
  CHECK(system_data("ID999 NR1 IDX2") == "failed line 3: ID999 NR1 IDX2 is not available");
  CHECK(system_data("ID50 NR1 IDX7") ==
        "failed line 3: Tool not defined: tool 7 is not in the tool table");
  CHECK(system_data("ID240 NR1 IDX9") == "failed line 3: ID240 NR1 IDX9 is not available");
  CHECK(system_data("ID360 NR1 IDX1") == "failed line 3: ID360 NR1 IDX1 is not available");
  for (const std::string address : {"ID240 NR1 IDX4", "ID220 NR2 IDX6", "ID230 NR2 IDX5"})
    CHECK(system_data(address) == "failed line 3: " + address + " is not available");
  CHECK(outcome(Control().run("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 A+5")) ==
        "failed line 3: Axis not available: A");
  for (const std::string address : {"ID350 NR55 IDX3", "ID350 NR50 IDX1"})
    CHECK(system_data(address, "TOOL CALL 30 Z") ==
          "failed line 3: " + address + " is not available");
  CHECK(Control().first_finding("FN 18: SYSREAD Q1 = ID350 NR55 IDX3") ==
        "FN 18: ID350 NR55 IDX3 is not available here: the run fails when it reaches this block");
  CHECK(system_data("ID20 NR1.5").starts_with("failed line 3: Input value incorrect"));
}

TEST_CASE("the basic rotation of FN 18 is around the tool axis") {
  for (const std::string axis : {"X", "Y", "Z"}) {
    CHECK(system_data("ID210 NR1", "TOOL CALL 30 " + axis +
                                       "\nTCH PROBE 404 SET BASIC ROTATION Q307=+20 Q305=+0") ==
          "20");
  }
}

TEST_CASE("FN 17 writes tools, presets and the datum table") {
  Control control;
  control.file("zero.d", "BEGIN ZERO .D MM\nNR      X         Y\n3       +0        +0\n[END]\n");
  const RunResult result = control.run(
      "FN 17: SYSWRITE ID50 NR1 IDX30 = +130.5\nFN 18: SYSREAD Q1 = ID50 NR1 IDX30\n"
      "FN 17: SYSWRITE ID503 NR7 IDX2 = -12\nFN 18: SYSREAD Q2 = ID503 NR7 IDX2\n"
      "SEL TABLE \"zero.d\"\nFN 17: SYSWRITE ID500 NR3 IDX1 = +4.5\n"
      "FN 18: SYSREAD Q3 = ID500 NR3 IDX1");
  check_completes(result, "Q1=130.5, Q2=-12, Q3=4.5");
  REQUIRE(result.files.size() == 1);
  CHECK(result.files[0].path.text() == "TNC:\\nc_prog\\zero.d");
  CHECK(outcome(control.run("FN 17: SYSWRITE ID20 NR1 = 5")) ==
        "failed line 2: ID20 NR1 is not available");
}

TEST_CASE("FN 26 and SEL TABLE of one file see and keep each other's rows") {
  Control control;
  control.file("zero.d", "BEGIN ZERO .D MM\nNR      X\n1       +1\n2       +2\n[END]\n");
  const std::string shift = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #1\n";
  const std::string shown = "FN 18: SYSREAD Q2 = ID220 NR2 IDX1\n";
  const std::string select = "SEL TABLE \"zero.d\"\n";
  const std::string open = "FN 26: TABOPEN ZERO.D\n";
  const std::string write = "Q1 = 70\nFN 27: TABWRITE 1/\"X\" = Q1\n";
  check_completes(control.run(open + write + select + shift + shown), "Q2=70");
  check_completes(control.run(select + open + write + shift + shown), "Q2=70");
  const RunResult result = control.run(select + open + write +
                                       "FN 17: SYSWRITE ID500 NR2 IDX1 = +80\n"
                                       "FN 28: TABREAD Q3 = 2/\"X\"");
  check_completes(result, "Q3=80");
  REQUIRE(result.files.size() == 1);
  CHECK(result.files[0].bytes == "BEGIN ZERO .D MM\nNR      X\n1       70\n2       80\n[END]\n");
}

TEST_CASE("a datum table in INCH has lengths in inches and angles in degrees") {
  Control control;
  control.setup.features = {machine::Block{{25.4, -50, -40}, {90, 50, 0}}};
  control.file("zero.d", "BEGIN ZERO .D INCH\nNR      X         C\n3       +1        +2\n[END]\n");
  check_completes(
      control.run("SEL TABLE \"zero.d\"\nFN 18: SYSREAD Q1 = ID500 NR3 IDX1\n"
                  "FN 18: SYSREAD Q2 = ID500 NR3 IDX6\nTOOL CALL 30 Z\n"
                  "TCH PROBE 419 DATUM IN ONE AXIS Q263=+25.4 Q264=+0 Q261=-5 Q320=+0 Q260=+30 "
                  "Q272=+1 Q267=+1 Q305=+3 Q333=+0 Q303=+0\nFN 18: SYSREAD Q3 = ID500 NR3 IDX1\n"
                  "FN 17: SYSWRITE ID500 NR3 IDX1 = +50.8\nFN 26: TABOPEN zero.d\n"
                  "FN 28: TABREAD Q4 = 3/\"X\""),
      "Q1=25.4, Q2=2, Q3=25.4, Q4=2");
}

TEST_CASE("a cell of a datum table that is no number is an error that names it") {
  Control control;
  control.file("zero.d",
               "BEGIN ZERO .D MM\nNR      X         Y\n1       +1O       +2\n2       +1\n[END]\n");
  const auto shift = [&](std::string_view block) {
    return outcome(control.run("SEL TABLE \"zero.d\"\n" + std::string(block)));
  };
  const std::string fails = "failed line 4: datum table TNC:\\nc_prog\\zero.d: ";
  const std::string first = shift("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #1");
  CHECK(first.starts_with(fails));
  CHECK(first.find("row 1, column X") != std::string::npos);
  CHECK(shift("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #2") == "completed");
  CHECK(shift("FN 18: SYSREAD Q1 = ID500 NR2 IDX1") == "completed");
  CHECK(shift("FN 18: SYSREAD Q1 = ID500 NR2 IDX2") ==
        "failed line 3: ID500 NR2 IDX2 is not available");
  CHECK(shift("FN 18: SYSREAD Q1 = ID500 NR1 IDX3") ==
        "failed line 3: ID500 NR1 IDX3 is not available");
}

TEST_CASE("tables: missing rows, columns and values are errors that name them") {
  Control control;
  control.file("t.tab", "BEGIN T .TAB MM\nNR      X         Y\n0       +1\n[END]\n");
  const auto read = [&](const std::string& cell) {
    return outcome(control.run("FN 26: TABOPEN t.tab\nFN 28: TABREAD Q1 = " + cell));
  };
  CHECK(read("0/\"X\"") == "completed");
  CHECK(read("5/\"X\"").starts_with("failed line 3: table TNC:\\nc_prog\\t.tab: "));
  CHECK(read("0/\"Z\"").starts_with("failed line 3: table TNC:\\nc_prog\\t.tab: "));
  CHECK(read("0/\"Y\"").starts_with("failed line 3: table TNC:\\nc_prog\\t.tab: "));
  control.file("t.tab", "BEGIN T .TAB MM\nNR      X\n0       +1\n");
  CHECK(read("0/\"X\"").starts_with("failed line 2: table TNC:\\nc_prog\\t.tab cannot be read"));
}

TEST_CASE("a number beyond the rows of a table reaches none of them") {
  Control control;
  const auto preset_x = [](const RunResult& result, int number) {
    for (const machine::Preset& preset : result.presets) {
      if (preset.number == number) return preset.frame.origin.x;
    }
    return -1.0;
  };
  const RunResult wrapped =
      control.run("Q5 = 4294967\nQ5 = Q5 * 1000 + 296\nFN 17: SYSWRITE ID503 NRQ5 IDX1 = 5");
  CHECK(outcome(wrapped) ==
        "failed line 4: Input value incorrect: 4294967296 is outside of -2147483648 to 2147483647");
  CHECK(preset_x(wrapped, 0) == 0);
  CHECK(control.run("FN 17: SYSWRITE ID503 NR9999 IDX1 = 5").status == RunStatus::Completed);
  CHECK(outcome(control.run("FN 17: SYSWRITE ID503 NR10000 IDX1 = 5")) ==
        "failed line 2: ID503 NR10000 IDX1 is not available");
  const std::string tool = "Q5 = 4294967\nQ5 = Q5 * 1000 + 326\n";
  CHECK(control.run(tool + "FN 18: SYSREAD Q1 = ID50 NR1 IDXQ5").status == RunStatus::Failed);
  CHECK(control.run(tool + "FN 17: SYSWRITE ID50 NR1 IDXQ5 = 5").status == RunStatus::Failed);
  const RunResult fn14 = control.run("Q5 = 4294968\nQ5 = Q5 * 1000 + 296\nFN 14: ERROR = Q5");
  CHECK(fn14.messages.back().number != 1000);
}

}  // namespace
}  // namespace fitgauge::interpreter

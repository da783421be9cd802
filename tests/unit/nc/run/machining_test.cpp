#include "workshop.hpp"

/// Machining cycles as motion: positions, depths and feeds worked out by hand from the steps the
/// control's manuals give.
namespace fitgauge::interpreter {
namespace {

TEST_CASE("200 goes back to the clearance and down to it above what is drilled") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 200 DRILLING Q200=2 Q201=-12 Q206=150 Q202=5 Q210=0.1 Q203=+1 Q204=20 "
                  "Q211=0.5") == Lines{"L Z+3 FMAX", "L Z-4 F150", "L Z+3 FMAX", "DWELL 0.1",
                                       "L Z-2 FMAX", "L Z-9 F150", "L Z+3 FMAX", "DWELL 0.1",
                                       "L Z-7 FMAX", "L Z-11 F150", "DWELL 0.5", "L Z+3 FMAX",
                                       "L Z+21 FMAX"});
}

TEST_CASE("Q208 = 0 retracts at the feed of plunging") {
  Workshop mill;
  const std::string reaming =
      "CYCL DEF 201 REAMING Q200=2 Q201=-15 Q206=100 Q211=0.5 Q203=+0 Q204=20 Q208=";
  CHECK(mill.hole(reaming + "0") ==
        Lines{"L Z+2 FMAX", "L Z-15 F100", "DWELL 0.5", "L Z+2 F100", "L Z+20 FMAX"});
  CHECK(mill.hole(reaming + "250")[3] == "L Z+2 F250");
  CHECK(mill.hole(reaming + "MAX")[3] == "L Z+2 FMAX");
}

TEST_CASE("203 breaks chips, then clears them, and takes less each time") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 203 UNIVERSAL Q200=2 Q201=-12 Q206=150 Q202=5 Q203=+0 Q204=0 Q213=1 "
                  "Q208=0 Q256=0.2") == Lines{"L Z+2 FMAX", "L Z-5 F150", "L Z-4.8000 F150",
                                              "L Z-10 F150", "L Z+2 F150", "L Z-8 FMAX",
                                              "L Z-12 F150", "L Z+2 F150"});
  const Lines less = mill.hole(
      "CYCL DEF 203 UNIVERSAL Q200=2 Q201=-12 Q206=150 Q202=5 Q203=+0 Q212=1 Q205=3 Q208=0");
  CHECK(std::count(less.begin(), less.end(), "L Z-9 F150") == 1);
  CHECK(std::count(less.begin(), less.end(), "L Z-12 F150") == 1);
}

TEST_CASE("205 stops above what is drilled by a distance that grows") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 205 PECKING Q200=2 Q201=-10 Q206=150 Q202=5 Q203=+0 Q204=0 Q258=0.2 "
                  "Q259=0.4") == Lines{"L Z+2 FMAX", "L Z-5 F150", "L Z+2 FMAX", "L Z-4.7000 FMAX",
                                       "L Z-10 F150", "L Z+2 FMAX"});
  CHECK(mill.hole("CYCL DEF 205 PECKING Q200=2 Q201=-10 Q206=150 Q202=0 Q203=+0 Q257=4 Q256=1 "
                  "Q208=0") == Lines{"L Z+2 FMAX", "L Z-4 F150", "L Z-3 F150", "L Z-8 F150",
                                     "L Z-7 F150", "L Z-10 F150", "L Z+2 F150"});
}

TEST_CASE("202 withdraws from the wall, 204 enters beside the hole") {
  Workshop mill;
  CHECK(mill.path("CYCL DEF 202 BORING Q200=2 Q201=-15 Q206=100 Q208=0 Q203=+0 Q204=0 Q214=3\n"
                  "CYCL CALL") == Lines{"L X+10 Y+10 Z+2 FMAX", "L X+10 Y+10 Z-15 F100",
                                        "L X+10.2000 Y+10 Z-15 F100", "L X+10.2000 Y+10 Z+2 F100",
                                        "L X+10 Y+10 Z+2 FMAX"});
  CHECK(
      mill.path("CYCL DEF 204 BACK BORING Q200=2 Q249=+5 Q250=20 Q251=3 Q252=15 Q253=750 Q254=200 "
                "Q203=+0 Q214=1\nCYCL CALL") ==
      Lines{"L X+10 Y+10 Z+2 FMAX", "L X+7 Y+10 Z+2 FMAX", "L X+7 Y+10 Z-37 F750",
            "L X+10 Y+10 Z-37 FMAX", "L X+10 Y+10 Z-30 F200", "L X+10 Y+10 Z-37 F750",
            "L X+7 Y+10 Z-37 FMAX", "L X+7 Y+10 Z+2 F750", "L X+10 Y+10 Z+2 FMAX"});
}

TEST_CASE("tapping runs at the pitch times the speed, out again too") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 207 RIGID TAPPING Q200=2 Q201=-10 Q239=+1.5 Q203=+0 Q204=0") ==
        Lines{"L Z+2 FMAX", "L Z-10 F1500", "L Z+2 F1500"});
  CHECK(mill.hole("CYCL DEF 209 TAPPING Q200=2 Q201=-10 Q239=+1 Q203=+0 Q204=0 Q257=6 Q256=1 "
                  "Q403=2") ==
        Lines{"L Z+2 FMAX", "L Z-6 F1000", "L Z-5 F1000", "L Z-10 F1000", "L Z+2 F2000"});
}

TEST_CASE("the cycles of old listings begin at their clearance") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP -2\nCYCL DEF 1.2 DEPTH -10\n"
                  "CYCL DEF 1.3 PECKG -6\nCYCL DEF 1.4 DWELL 0.5\nCYCL DEF 1.5 F100\nL Z+2 FMAX") ==
        Lines{"L Z+2 FMAX", "L Z-6 F100", "L Z+2 FMAX", "L Z-5.4000 FMAX", "L Z-10 F100",
              "DWELL 0.5", "L Z+2 FMAX"});
  CHECK(mill.hole("CYCL DEF 2 .0 GEWINDEBOHREN\nCYCL DEF 2 .1 ABST 2\nCYCL DEF 2 .2 TIEFE -10\n"
                  "CYCL DEF 2 .3 V.ZEIT 0\nCYCL DEF 2 .4 F200\nL Z+2 FMAX") ==
        Lines{"L Z+2 FMAX", "L Z-10 F200", "L Z+2 F200"});
  CHECK(mill.hole("CYCL DEF 18.0 THREAD CUTTING\nCYCL DEF 18.1 DEPTH -20\nCYCL DEF 18.2 PITCH +1\n"
                  "L Z+2 FMAX") == Lines{"L Z+2 FMAX", "L Z-18 F1000", "L Z+2 F1000"});
  const Lines pocket = mill.path(
      "CYCL DEF 5.0 CIRCULAR POCKET\nCYCL DEF 5.1 SET UP -2\nCYCL DEF 5.2 DEPTH -3\n"
      "CYCL DEF 5.3 PECKG -3 F80\nCYCL DEF 5.4 RADIUS 15\nCYCL DEF 5.5 F100 DR+\nL Z+2 FMAX M99");
  CHECK(pocket == Lines{"L X+10 Y+10 Z+2 FMAX", "L X+10 Y+10 Z-3 F80", "L X+21 Y+10 Z-3 F100",
                        "ARC X+21 Y+10 Z-3 CC X+10 Y+10 Z-3 +360 F100", "L X+10 Y+10 Z-3 F100",
                        "L X+10 Y+10 Z+2 FMAX"});
}

TEST_CASE("208 mills a helix of Q334 a turn and a full circle") {
  Workshop mill;
  CHECK(mill.path("CYCL DEF 208 BORE MILLING Q200=2 Q201=-10 Q206=150 Q334=2 Q203=+0 Q204=20 "
                  "Q335=20 Q342=0 Q351=+1\nCYCL CALL") ==
        Lines{"L X+10 Y+10 Z+2 FMAX", "ARC X+16 Y+10 Z+2 CC X+13 Y+10 Z+2 +180 F150",
              "ARC X+16 Y+10 Z-10 CC X+10 Y+10 Z-10 +2160 F150",
              "ARC X+16 Y+10 Z-10 CC X+10 Y+10 Z-10 +360 F150",
              "ARC X+10 Y+10 Z-10 CC X+13 Y+10 Z-10 +180 F150", "L X+10 Y+10 Z+2 FMAX",
              "L X+10 Y+10 Z+20 FMAX"});
  CHECK(mill.hole("CYCL DEF 208 BORE MILLING Q201=-10 Q206=150 Q335=8") ==
        Lines{"L Z+2 FMAX", "L Z-10 F150", "L Z+2 FMAX"});
  mill.path("CYCL DEF 208 BORE MILLING Q201=-10 Q206=150 Q335=7\nCYCL CALL");
  CHECK(mill.last.messages.back().number == 1003);
}

TEST_CASE("pockets and slots follow their finished contour at each depth") {
  Workshop mill;
  const std::string depths = " Q207=300 Q206=100 Q201=-4 Q202=4 Q200=2 Q203=+0 Q204=0";
  CHECK(mill.path("CYCL DEF 251 POCKET Q218=40 Q219=20 Q220=6" + depths + "\nCYCL CALL") ==
        Lines{"L X+10 Y+10 Z+2 FMAX", "L X+10 Y+10 Z-4 F100", "L X+26 Y+10 Z-4 F300",
              "L X+26 Y+14 Z-4 F300", "ARC X+24 Y+16 Z-4 CC X+24 Y+14 Z-4 +90 F300",
              "L X-4 Y+16 Z-4 F300", "ARC X-6 Y+14 Z-4 CC X-4 Y+14 Z-4 +90 F300",
              "L X-6 Y+6 Z-4 F300", "ARC X-4 Y+4 Z-4 CC X-4 Y+6 Z-4 +90 F300",
              "L X+24 Y+4 Z-4 F300", "ARC X+26 Y+6 Z-4 CC X+24 Y+6 Z-4 +90 F300",
              "L X+26 Y+10 Z-4 F300", "L X+10 Y+10 Z-4 F300", "L X+10 Y+10 Z+2 FMAX"});
  // Up-cut goes the other way; a corner as datum moves the centre; roughing leaves its allowance.
  const Lines other = mill.path(
      "CYCL DEF 251 POCKET Q215=1 Q218=40 Q219=20 Q220=0 Q368=1 Q369=0.5 "
      "Q367=1 Q351=-1" +
      depths + "\nCYCL CALL");
  CHECK(std::count(other.begin(), other.end(), "L X+30 Y+20 Z-3.5000 F100") == 1);
  CHECK(std::count(other.begin(), other.end(), "L X+45 Y+15 Z-3.5000 F300") == 1);
  CHECK(mill.path("CYCL DEF 252 POCKET Q223=30" + depths + "\nCYCL CALL")[3] ==
        "ARC X+21 Y+10 Z-4 CC X+10 Y+10 Z-4 +360 F300");
  const Lines slot =
      mill.path("CYCL DEF 253 SLOT Q218=30 Q219=10 Q374=90" + depths + "\nCYCL CALL");
  CHECK(std::count(slot.begin(), slot.end(), "L X+10 Y+21 Z-4 F300") == 1);
  const Lines ring =
      mill.path("CYCL DEF 254 SLOT Q219=10 Q375=80 Q216=+50 Q217=+50 Q376=0 Q248=90" + depths +
                "\nCYCL CALL");
  CHECK(std::count(ring.begin(), ring.end(), "ARC X+50 Y+91 Z-4 CC X+50 Y+50 Z-4 +90 F300") == 1);
  CHECK(std::count(ring.begin(), ring.end(), "ARC X+89 Y+50 Z-4 CC X+50 Y+50 Z-4 -90 F300") == 1);
  mill.path("CYCL DEF 252 POCKET Q223=7" + depths + "\nCYCL CALL");
  CHECK(mill.last.messages.back().number == 1029);
}

TEST_CASE("262 mills the thread as a helix at its pitch") {
  Workshop mill;
  CHECK(mill.path("CYCL DEF 262 THREAD Q335=20 Q239=+1.5 Q201=-6 Q355=1 Q253=750 Q351=+1 Q200=2 "
                  "Q203=+0 Q204=0 Q207=200\nCYCL CALL") ==
        Lines{"L X+10 Y+10 Z+2 FMAX", "L X+10 Y+10 Z-6 F750",
              "ARC X+16 Y+10 Z-6 CC X+13 Y+10 Z-6 +180 F200",
              "ARC X+16 Y+10 Z+0 CC X+10 Y+10 Z+0 +1440 F200",
              "ARC X+10 Y+10 Z+0 CC X+13 Y+10 Z+0 +180 F200", "L X+10 Y+10 Z+2 FMAX"});
}

const std::string kDrill = "CYCL DEF 200 DRILLING Q200=2 Q201=-3 Q206=150 Q202=0 Q203=+0 Q204=20\n";

/// Where a cycle cuts, in order.
Lines cuts(const Lines& moves) {
  Lines at;
  for (const std::string& line : moves) {
    if (line.ends_with(" Z-3 F150")) at.push_back(line.substr(2, line.size() - 11));
  }
  return at;
}

TEST_CASE("220 and 221 run the cycle before them at each point") {
  Workshop mill;
  CHECK(cuts(mill.path(kDrill + "CYCL DEF 220 POLAR PATTERN Q216=+50 Q217=+50 Q244=40 Q245=+0 "
                                "Q246=+360 Q247=+0 Q241=4 Q200=2 Q203=+0 Q204=20 Q301=1")) ==
        Lines{"X+70 Y+50", "X+50 Y+70", "X+30 Y+50", "X+50 Y+30"});
  CHECK(cuts(mill.path(kDrill + "CYCL DEF 220 POLAR PATTERN Q216=+50 Q217=+50 Q244=40 Q245=+0 "
                                "Q246=+90 Q241=3")) ==
        Lines{"X+70 Y+50", "X+64.1421 Y+64.1421", "X+50 Y+70"});
  CHECK(cuts(mill.path(kDrill + "CYCL DEF 221 PATTERN Q225=+15 Q226=+10 Q237=+10 Q238=+8 Q242=2 "
                                "Q243=2 Q224=+0")) ==
        Lines{"X+15 Y+10", "X+25 Y+10", "X+25 Y+18", "X+15 Y+18"});
  mill.path("CYCL DEF 221 PATTERN Q242=2");
  CHECK(mill.last.messages.back().number == 1027);
}

TEST_CASE("CYCL CALL POS: the tool axis shifts the cycle like a datum") {
  Workshop mill;
  CHECK(mill.path(kDrill + "CYCL CALL POS X+20 Y+30 Z+5 F2000\nL X+0 Y+0 FMAX M99") ==
        Lines{"L X+20 Y+30 Z+50 F2000", "L X+20 Y+30 Z+7 FMAX", "L X+20 Y+30 Z+2 F150",
              "L X+20 Y+30 Z+7 FMAX", "L X+20 Y+30 Z+25 FMAX", "L X+0 Y+0 Z+25 FMAX",
              "L X+0 Y+0 Z+2 FMAX", "L X+0 Y+0 Z-3 F150", "L X+0 Y+0 Z+2 FMAX",
              "L X+0 Y+0 Z+20 FMAX"});
  // From below the surface it rises first.
  CHECK(mill.path(kDrill + "L Z-1 FMAX\nCYCL CALL POS X+20 Y+30 Z+0 FMAX")[1] ==
        "L X+10 Y+10 Z+2 FMAX");
}

TEST_CASE("PATTERN DEF gives CYCL CALL PAT its points") {
  Workshop mill;
  const auto points = [&](const std::string& pattern) {
    return cuts(mill.path(kDrill + "PATTERN DEF " + pattern + "\nCYCL CALL PAT FMAX M3"));
  };
  CHECK(points("POS1 (X+25 Y+33,5 Z+0) ~\nPOS2 (X+50 Y+75 Z+0)") ==
        Lines{"X+25 Y+33.5000", "X+50 Y+75"});
  CHECK(points("ROW1 (X+25 Y+33 D+8 NUM3 ROT+90 Z+0)") ==
        Lines{"X+25 Y+33", "X+25 Y+41", "X+25 Y+49"});
  CHECK(points("PAT1 (X+0 Y+0 DX+8 DY+10 NUMX2 NUMY2 ROT+0 ROTX+0 ROTY+0 Z+0)") ==
        Lines{"X+0 Y+0", "X+8 Y+0", "X+0 Y+10", "X+8 Y+10"});
  CHECK(points("FRAME1 (X+0 Y+0 DX+8 DY+10 NUMX3 NUMY3 Z+0)").size() == 8);
  CHECK(points("CIRC1 (X+25 Y+33 D80 START+45 NUM2 Z+0)").size() == 2);
  CHECK(points("PITCHCIRC1 (X+0 Y+0 D80 START+0 STEP90 NUM2 Z+0)") ==
        Lines{"X+40 Y+0", "X+0 Y+40"});
  mill.path(kDrill + "CYCL CALL PAT");
  CHECK(mill.last.messages.back().number == 1017);
}

TEST_CASE("values out of a parameter's range are refused before the program runs") {
  Control control;
  control.program("CYCL DEF 200 DRILLING Q202=-5 Q305=3");
  const auto found = control.diagnostics();
  REQUIRE(found.size() == 2);
  CHECK(found[0].severity == klartext::Severity::Error);
  CHECK(found[1].message == "cycle 200 has no parameter Q305; did you mean Q395?");
}

TEST_CASE("the builder's M functions and cycles are data of the setup") {
  Workshop mill;
  mill.path("L X+1 FMAX M55");
  CHECK(outcome(mill.last).find(R"("m_functions":{"55":"ignore"})") != std::string::npos);
  mill.path("CYCL DEF 392 ATC Q240=1");
  CHECK(outcome(mill.last).find(R"("cycles":{"392":"ignore"})") != std::string::npos);
  mill.options.builder.m_functions[55] = {};
  mill.options.builder.cycles[392] = {};
  mill.options.builder.cycles[332] = {};
  CHECK(mill.path("L X+1 FMAX M55\nCYCL DEF 392 ATC Q240=1\nCYCL CALL\nCYCL DEF 332.0 TUNING\n"
                  "CYCL DEF 332.1 X\nL X+2 FMAX M99")
            .size() == 2);
  CHECK(outcome(mill.last) == "completed");
  mill.file("oem.h", "BEGIN PGM OEM MM\nQ1 = Q240 + 1\nEND PGM OEM MM\n");
  const auto path = ControlPath::parse("TNC:\\nc_prog\\oem.h").value();
  mill.options.builder.m_functions[25] = {path};
  mill.options.builder.cycles[392] = {path};
  mill.path("Q240 = 7\nL X+1 FMAX M25\nQ2 = Q1");
  CHECK(value(mill.last, "Q2") == "8");
  mill.path("CYCL DEF 392 ATC Q240=+3\nQ2 = Q1");
  CHECK(value(mill.last, "Q2") == "4");
}

TEST_CASE("an unreadable line is an ERROR block where the order says so") {
  Control control;
  control.program("Q1 = 1\nRUBBISH\nQ1 = 2");
  const auto file = control.programs.get(*control.disk.find(Control::main_path()));
  CHECK(file->program == nullptr);
  REQUIRE(file->with_error_blocks != nullptr);
  CHECK(has_errors(file->diagnostics));
  CHECK_FALSE(has_errors(file->diagnostics, true));
  control.program("CALL LBL 9\nRUBBISH");
  CHECK(control.programs.get(*control.disk.find(Control::main_path()))->with_error_blocks ==
        nullptr);
}

TEST_CASE("findings carry notes and what was probably meant") {
  Control control;
  control.program("LBL 5\nLBL 0\nLBL 5");
  auto found = control.diagnostics();
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].notes.size() == 1);
  CHECK(found[0].notes[0].message == "label 5 is also in line 2");
  control.program("LBL \"UP1\"\nLBL 0\nCALL LBL \"UPP1\"\nCYCLE DEF 9.0");
  found = control.diagnostics();
  REQUIRE(found.size() == 2);
  CHECK(found[0].message == "label \"UPP1\" is not defined in this program; did you mean UP1?");
  CHECK(found[1].message == "no block begins with 'CYCLE'; did you mean CYCL?");
  control.program("TOOL CALLL 5\nCYCL DEFF 9.0\nPLANE SPATAIL SPA+0\nTOOL X");
  found = control.diagnostics();
  REQUIRE(found.size() == 4);
  CHECK(found[0].message == "expected CALL or DEF, found 'CALLL'; did you mean CALL?");
  CHECK(found[1].message == "expected CALL or DEF, found 'DEFF'; did you mean DEF?");
  CHECK(found[2].message.ends_with("found 'SPATAIL'; did you mean SPATIAL?"));
  CHECK(found[3].message == "expected CALL or DEF, found 'X'");
  control.file("main.h", "($Message)\nBEGIN PGM A MM\nEND PGM A MM\n");
  found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].message ==
        "expected a block, found '('; a program begins with BEGIN PGM name MM, or INCH");
}

TEST_CASE("what has no effect is said once, what would be wrong is an error") {
  Workshop mill;
  mill.path("LN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0.1 TY+0 TZ+0.995 F100\nL Z+9 FMAX M92");
  REQUIRE(mill.last.messages.size() == 2);
  CHECK(mill.last.messages[0].text.starts_with("LN: the tool vector"));
  CHECK(mill.last.messages[0].column == 1);
  CHECK(mill.last.messages[0].source.starts_with("LN X+1"));
  CHECK(mill.last.messages[1].text.starts_with("M92"));
  mill.path("FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR");
  CHECK(mill.last.messages.empty());
}

TEST_CASE("FUNCTION DWELL waits for seconds or turns") {
  Workshop mill;
  CHECK(mill.path("FUNCTION DWELL TIME2\nFUNCTION DWELL REV50") == Lines{"DWELL 2", "DWELL 3"});
}

TEST_CASE("FN 15 prints four decimals and the separator of the control") {
  Control control;
  const auto printed = [&] {
    const RunResult result = control.run("Q1 = -0.63164\nQ2 = 105.868\nFN 15: PRINT Q1/0/Q2");
    REQUIRE(result.files.size() == 1);
    return result.files[0].bytes;
  };
  CHECK(printed() == "-0,6316  +0  +105,868\n");
  control.options.decimal_comma = false;
  CHECK(printed() == "-0.6316  +0  +105.868\n");
}

TEST_CASE("logs and what FN 16 prints lie beside the program or in the folder of the control") {
  Control control;
  control.setup.features = {machine::Block{{0, 0, -40}, {100, 80, 0}}};
  control.file("mask.a", "\"text\";\n");
  const auto written = [&] {
    std::vector<std::string> paths;
    const RunResult result = control.run(
        "TOOL CALL 30 Z\nL Z+50 FMAX\nFN 16: F-PRINT mask.a / out.txt\n"
        "FN 16: F-PRINT mask.a / sub\\out.txt\nFN 16: F-PRINT mask.a / TNC:\\out.txt\n"
        "TCH PROBE 427 MEASURE COORDINATE Q263=+50 Q264=+40 Q261=+0 Q320=+0 Q272=+3 Q267=-1 "
        "Q260=+50 Q281=+1 Q288=+1 Q289=-1 Q309=+0 Q330=+0");
    CHECK(outcome(result) == "completed");
    for (const WrittenFile& file : result.files) paths.push_back(file.path.text());
    std::sort(paths.begin(), paths.end());
    return paths;
  };
  CHECK(written() == Lines{"TNC:\\nc_prog\\TCHPR427.TXT", "TNC:\\nc_prog\\out.txt",
                           "TNC:\\nc_prog\\sub\\out.txt", "TNC:\\out.txt"});
  control.options.print_folder = ControlPath::parse("TNC:\\logs\\log").value();
  CHECK(written() == Lines{"TNC:\\logs\\TCHPR427.TXT", "TNC:\\logs\\out.txt",
                           "TNC:\\nc_prog\\sub\\out.txt", "TNC:\\out.txt"});
}

}  // namespace
}  // namespace fitgauge::interpreter

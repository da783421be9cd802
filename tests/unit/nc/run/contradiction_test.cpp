#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "nc/probing/cycles.hpp"
#include "nc/program/cycles.hpp"
#include "run_fixture.hpp"
#include "support/files.hpp"

namespace fitgauge::interpreter {
namespace {

const std::string kHole =
    "Q273=+50 ;CENTER IN 1ST AXIS ~\n Q274=+50 ;CENTER IN 2ND AXIS ~\n Q262=+12 ;NOMINAL DIAMETER "
    "~\n Q325=+0 ~\n "
    "Q247=+90 ;STEPPING ANGLE ~\n Q261=-5 ;MEASURING HEIGHT ~\n Q320=+0 ;SET-UP CLEARANCE ~\n "
    "Q260=+20 ;CLEARANCE HEIGHT ~\n "
    "Q301=+0 ~\n Q275=+12.1 ;MAX. ~\n Q276=+12 ;MIN. ~\n Q279=+0 ~\n Q280=+0 ~\n Q281=+0 ~\n "
    "Q309=+0 ~\n Q330=+0\n";

std::string hole(std::string dialog = "MEASURE HOLE") {
  return "TCH PROBE 421 " + dialog + " ~\n " + kHole;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), by);
}

/// `warning 3 cycle.order_contradicts` for each finding.
std::vector<std::string> findings(std::string_view body) {
  Control control;
  control.program(std::string(body) + "\nTOOL CALL 0 Z");
  std::vector<std::string> found;
  for (const auto& each : control.diagnostics()) {
    found.push_back(std::string(word(each.severity)) + " " + std::to_string(each.range.begin.line) +
                    " " + std::string(id(each.code)));
  }
  return found;
}

TEST_CASE("a contradiction is found at its line") {
  using Found = std::vector<std::string>;
  struct Case {
    std::string body;
    Found found;
  };
  const std::string dialog = "warning 2 cycle.dialog_contradicts";
  const std::string order = "warning 2 cycle.order_contradicts";
  const std::string by_q1 = replaced(hole(), "Q275=+12.1", "Q275=+Q1");
  const std::string datum = "TCH PROBE 417 DATUM IN TS AXIS Q263=0 Q264=0 Q294=-5 Q260=9 Q303=-1 ";
  const std::string rotary =
      "TCH PROBE 403 ROT IN ROTARY AXIS Q263=0 Q264=0 Q265=9 Q266=0 Q272=2 Q267=1 Q261=-5 Q260=9 ";
  const std::string drill =
      "CYCL DEF 200 DRILLING ~\n Q200=+2 ;SET-UP CLEARANCE ~\n Q201=-10 ;DEPTH ~\n "
      "Q206=+200 ;FEED RATE FOR PLNGNG ~\n Q202=+5 ;PLUNGING DEPTH\n";
  const Case cases[] = {
      // depths and heights with a wrong sign
      {"CYCL DEF 20 CONTOUR DATA Q1=+20 Q5=+0 Q6=+2 Q7=+50", {order}},
      {"CYCL DEF 20 CONTOUR DATA Q1=-20 Q5=+0 Q6=+2 Q7=-5", {order}},
      {"CYCL DEF 20 CONTOUR DATA Q1=-20 Q5=+0 Q6=+2 Q7=+50", {}},
      {"CYCL DEF 263 THREAD MLLNG/CNTSNKG Q335=10 Q239=1 Q201=-16 Q356=+20 Q207=100", {order}},
      {"CYCL DEF 264 THREAD DRILLNG/MLLNG Q335=10 Q239=1 Q201=-16 Q356=+20 Q206=100 Q207=100",
       {order}},
      {"CYCL DEF 264 THREAD DRILLNG/MLLNG Q335=10 Q239=1 Q201=-16 Q356=-20 Q206=100 Q207=100", {}},
      {"CYCL DEF 276 THREE-D CONT. TRAIN Q1=+20", {"warning 2 cycle.unknown", order}},
      {"CYCL DEF 371 BUILDER Q201=+20", {"warning 2 cycle.unknown"}},
      {"CYCL DEF 276 THREE-D CONT. TRAIN Q1=-20", {"warning 2 cycle.unknown"}},
      {"CYCL DEF 1.0 TIEFBOHREN\nCYCL DEF 1.1 ABST 2\nCYCL DEF 1.2 TIEFE +20",
       {"warning 4 cycle.order_contradicts"}},
      {"CYCL DEF 1.0 TIEFBOHREN\nCYCL DEF 1.1 ABST 2\nCYCL DEF 1.2 TIEFE -20", {}},
      {"CYCL DEF 4.0 POCKET MILLING\nCYCL DEF 4.1 SET UP 2\nCYCL DEF 4.2 DEPTH +10",
       {"warning 4 cycle.order_contradicts"}},
      // names of cycles in sub-lines and of cycle 247
      {"TCH PROBE 0.0 MEASURE HOLE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5", {dialog}},
      {"TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5", {}},
      {"TCH PROBE 0.0 BEZUGSEBENE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5", {}},
      {"CYCL DEF 7.0 ROTATION\nCYCL DEF 7.1 X+5", {dialog}},
      {"CYCL DEF 7.0 NULLPUNKT\nCYCL DEF 7.1 X+5", {}},
      {"CYCL DEF 10.0 DATUM SHIFT\nCYCL DEF 10.1 ROT+5", {dialog}},
      {"CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 X2", {}},
      {"CYCL DEF 247 MIRROR IMAGE Q339=+1", {dialog}},
      {"CYCL DEF 247 DATUM SETTING Q339=+1 ;DATUM NUMBER", {}},
      // machining cycles
      {drill, {}},
      {replaced(drill, "DRILLING", "BOHREN"), {}},
      {replaced(drill, "DRILLING", "TAPPING"), {dialog}},
      {replaced(drill, "DRILLING", "GEWINDEBOHREN NEU"), {dialog}},
      {replaced(drill, "DRILLING", "REAMING"), {dialog}},
      {replaced(drill, ";DEPTH", ";SET-UP CLEARANCE"), {"warning 4 cycle.comment_contradicts"}},
      {replaced(drill, "Q206=+200", "Q206=FMAX"), {"warning 5 cycle.order_contradicts"}},
      {"CYCL DEF 251 CIRCULAR POCKET Q218=+60 Q219=+20 Q201=-5\n", {dialog}},
      {hole(), {}},
      {hole("MESSEN BOHRUNG"), {}},
      {hole("MEASURE BOSS"), {dialog}},
      {hole("MEAS. CIRCLE OUTSIDE"), {dialog}},
      {hole("MEASURE PLANE"), {dialog}},
      {hole("MESSEN ZAPFEN"), {dialog}},
      {hole("MISURARE PERNO"), {dialog}},
      {hole("METEN TAPPEN"), {dialog}},
      {hole("POMIAR CZOPU"), {dialog}},
      {"; the boss D12\n" + hole(), {}},
      {"; clamp nut\n" + hole(), {}},
      {"; Meas. circle outside\n" + hole(), {"warning 3 cycle.comment_contradicts"}},
      {"; measure angle\n" + hole(), {}},
      {"; hole beside the boss\n" + hole(), {}},
      {replaced(hole(), ";MAX.", ";MIN."), {"warning 12 cycle.comment_contradicts"}},
      {replaced(hole(), ";MAX.", ";STUD"), {"warning 12 cycle.comment_contradicts"}},
      {replaced(hole(), "1ST AXIS", "2ND AXIS"), {"warning 3 cycle.comment_contradicts"}},
      {replaced(hole(), ";NOMINAL DIAMETER", ";MEASURING HEIGHT"),
       {"warning 5 cycle.comment_contradicts"}},
      {replaced(hole(), ";CENTER IN 1ST AXIS", ";START X"), {}},
      {replaced(hole(), ";MEASURING HEIGHT", ";Z POSITION"), {}},
      {replaced(hole(), ";MAX.", ";MIN. check:ignore"), {}},
      {replaced(hole(), ";MAX.", ";MIN. check:ignore cycle.comment_contradicts"), {}},
      {replaced(hole(), ";MAX.", ";MIN. CHECK:IGNORE"), {}},
      {replaced(hole(), ";MAX.", ";MIN. check:ignore file.missing, cycle.comment_contradicts"), {}},
      {replaced(hole(), ";MAX.", ";MIN. check:ignore cycle.comment_contradictsX"),
       {"warning 12 cycle.comment_contradicts"}},
      {replaced(hole(), ";MAX.", ";MIN. check:ignore file.missing"),
       {"warning 12 cycle.comment_contradicts"}},
      {"; check:ignore\n" + hole("MEASURE BOSS"), {}},
      {"7 ; check:ignore\n8 " + hole("MEASURE BOSS"), {}},
      {"CALL PGM OTHER ;check:ignore file.missing", {}},
      {replaced(hole(), "Q275=+12.1", "Q275=+11"), {"warning 12 cycle.order_contradicts"}},
      {replaced(hole(), "Q275=+12.1", "Q275=+121"), {"warning 12 cycle.order_contradicts"}},
      {replaced(hole(), "Q276=+12 ", "Q276=+1.2 "), {"warning 13 cycle.order_contradicts"}},
      {replaced(hole(), "Q275=+12.1", "Q275=+13.2"), {}},
      {replaced(hole(), "Q260=+20", "Q260=-20"), {"warning 10 cycle.order_contradicts"}},
      {replaced(hole(), "Q247=+90", "Q247=+0"), {"warning 7 cycle.order_contradicts"}},
      {replaced(hole(), "Q247=+90", "Q247=-4.9"), {"warning 7 cycle.order_contradicts"}},
      {replaced(hole(), "Q247=+90", "Q247=-5"), {}},
      {"Q1 = 0\n" + replaced(hole(), "Q247=+90", "Q247=+Q1"), {order}},
      {"TCH PROBE 427 MEASURE COORDINATE Q263=0 Q264=0 Q261=-5 Q272=1 Q267=+0 Q260=9", {order}},
      {"TCH PROBE 427 MEASURE COORDINATE Q263=0 Q264=0 Q261=-5 Q272=1 Q267=-1 Q260=9", {}},
      {"TCH PROBE 1400 POSITION PROBING Q1100=0 Q1101=0 Q1102=0 Q372=+0 Q260=9", {order}},
      {"TCH PROBE 1400 POSITION PROBING Q1100=0 Q1101=0 Q1102=0 Q372=-3 Q260=9", {}},
      {datum + "Q305=9", {order}},
      {datum + "Q305=0", {}},
      {datum, {}},
      {"Q1 = 9\n" + datum + "Q305=+Q1", {order}},
      {replaced(datum, "-1 ", "+1 ") + "Q305=9", {}},
      {rotary + "Q337=1 Q305=9 Q303=-1", {order}},
      {rotary + "Q337=0 Q305=9 Q303=-1", {}},
      {replaced(hole(), "Q320=+0", "Q320=-1"), {"error 9 cycle.parameter_invalid"}},
      {replaced(hole(), "Q279=+0", "Q279=+20"), {"warning 14 cycle.order_contradicts"}},
      {replaced(hole(), "Q279=+0", "Q279=+1"), {}},
      // a parameter that is a number when the cycle begins, on the way to it or at a call
      {"Q1 = 121\n" + by_q1, {order}},
      {"Q1 = 12.1\n" + by_q1, {}},
      {"Q1 = 10\nLBL 4\nQ1 = Q1 + 0.7\nCALL LBL 4 REP 2\n" + by_q1, {}},
      {"Q1 = 120 + 1\n" + by_q1, {order}},
      {"FN 5: Q1 = SQRT +400\n" + by_q1, {order}},
      {"FN 1: Q1 = +6 + +6.1\n" + by_q1, {}},
      {"Q1 = SQRT ( 100 + 44 )\n" + by_q1, {}},
      {"Q1 = 1 / 0\n" + by_q1, {}},
      {"Q2 = 60\nQ1 = Q2 * 2\nQ2 = 6\n" + by_q1, {"warning 3 cycle.order_contradicts"}},
      {"Q1 = 60\nQ1 = Q1 + Q1\n" + by_q1, {"warning 3 cycle.order_contradicts"}},
      {"Q1 = Q2 * 0\n" + by_q1, {}},
      {"Q5 = -12.1\n" + replaced(hole(), "Q275=+12.1", "Q275=-Q5"), {}},
      {"Q5 = -121\n" + replaced(hole(), "Q275=+12.1", "Q275=-Q5"), {order}},
      {"Q1 = 121\nQ1 = Q2\n" + by_q1, {}},
      {"/Q1 = 121\n" + by_q1, {}},
      {"Q1 = 121\nFN 9: IF +Q5 EQU +0 GOTO LBL 3\nLBL 3\n" + by_q1, {}},
      {"Q1 = 121\nCALL PGM OTHER\n" + by_q1, {"warning 3 file.missing"}},
      {"Q1 = 121\nM30\n" + by_q1, {}},
      {"Q1 = 121\nL X+5 FMAX M25\n" + by_q1, {"warning 3 m_function.unknown"}},
      {"CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM OTHER\nQ1 = 121\nCYCL CALL\n" + by_q1,
       {"warning 3 file.missing"}},
      {"CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM OTHER\nQ1 = 121\nL X+5 FMAX M99\n" + by_q1,
       {"warning 3 file.missing"}},
      {"LBL 5\nQ1 = 121\nLBL 0\nLBL 6\n" + by_q1 + "LBL 0\n", {}},
      {"Q1 = 121\nCALL LBL 1\nM30\nLBL 1\n" + by_q1 + "LBL 0\n", {order}},
      {"Q1 = 12.1\nCALL LBL 1\nQ1 = 121\nCALL LBL 1\nM30\nLBL 1\n" + by_q1 + "LBL 0\n",
       {"warning 4 cycle.order_contradicts"}},
      {"Q1 = 121\nCALL LBL 1\nM30\nLBL 1\nQ1 = 12.1\n" + by_q1 + "LBL 0\n", {}},
      {"Q1 = 121\nCALL LBL 1\nM30\nLBL 1\nQ1 = Q7\n" + by_q1 + "LBL 0\n", {}},
      {"CYCL DEF 200 DRILLING Q200=2 Q201=5 Q206=100 Q202=5 Q203=0 Q204=50",
       {"warning 2 cycle.order_contradicts"}},
      {"TOOL CALL 5 Z S1000\nM3\n" + hole(), {"warning 4 cycle.stylus_missing"}},
      {"TOOL CALL 5 Z S1000\nM3\nTOOL CALL 30 Z\n" + hole(), {}},
      {"CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=100 Q202=5 Q203=0 Q204=50\n" + hole(),
       {"warning 3 cycle.stylus_missing"}},
      {hole() + "Q1 = Q153 + Q180", {}},
      {hole() + "Q1 = Q155", {"warning 19 parameter.result_unset"}},
      {"Q155 = 1\n" + hole() + "Q1 = Q155", {}},
      {replaced(hole(), " ~\n Q330", "\n Q330"), {"note 17 block.continuation_missing"}},
      {replaced(hole(), ";MIN. ~", "~ ;MIN."), {"note 13 block.continuation_missing"}},
      {replaced(hole(), " ~\n Q330", "\nQ330"), {"error 18 block.continuation_missing"}},
  };
  for (const Case& each : cases) {
    CAPTURE(each.body);
    CHECK(findings(each.body) == each.found);
  }
}

TEST_CASE("titles and comments of controls in all languages say what they mean") {
  struct Case {
    std::string_view cycle;
    bool contradicts;
  };
  const Case titles[] = {
      {"TCH PROBE 421 MEASURE ISLAND", true},
      {"TCH PROBE 421 MEASURE PIN", true},
      {"TCH PROBE 421 SHAFT", true},
      {"TCH PROBE 421 MESSEN WELLE", true},
      {"TCH PROBE 421 MESSEN INSEL", true},
      {"TCH PROBE 421 METEN TAP", true},
      {"TCH PROBE 421 METEN EILAND", true},
      {"TCH PROBE 422 MEASURE PIN", false},
      {"TCH PROBE 422 METEN TAP", false},
      {"TCH PROBE 409 GROOVE", true},
      {"TCH PROBE 408 GROOVE", false},
      {"CYCL DEF 209 BORING SPINDLE ORIENTED", true},
      {"CYCL DEF 202 BOHREN", false},
      {"TCH PROBE 427 MEASURE BORE", true},
      {"TCH PROBE 412 DATUM IN Z", true},
      {"TCH PROBE 417 DATUM IN Z", false},
      {"CYCL DEF 206 GEW.-BOHREN NEU", false},
      {"CYCL DEF 207 GEW.-BOHREN GS NEU", false},
      {"CYCL DEF 209 GEW.-BOHREN SPANBR.", false},
      {"CYCL DEF 200 GEW.-BOHREN NEU", true},
      {"CYCL DEF 207 BOHREN", true},
      {"CYCL DEF 264 THREAD DRILLING", false},
  };
  const auto contradicts = [](std::string_view body, std::string_view code) {
    return std::ranges::any_of(findings(body),
                               [&](const auto& each) { return each.ends_with(code); });
  };
  for (const Case& each : titles) {
    CAPTURE(each.cycle);
    CHECK(contradicts(each.cycle, "cycle.dialog_contradicts") == each.contradicts);
  }
  CHECK_FALSE(contradicts("; the shaft's seat\n" + hole(), "cycle.comment_contradicts"));
  // What controls write, then what contradicts it.
  const std::string_view comments[][3] = {
      {"Q273", "MITTE 1. ACHSE", "MITTE 2. ACHSE"},
      {"Q274", "CENTER IN 2ND AXIS", "CENTER IN 1ST AXIS"},
      {"Q262", "SOLL-DURCHMESSER", "MESSHOEHE"},
      {"Q325", "STARTWINKEL", "WINKELSCHRITT"},
      {"Q325", "STARTING ANGLE", "START DEPTH"},
      {"Q247", "WINKELSCHRITT", "STARTWINKEL"},
      {"Q247", "PASSO ANGOLARE", "ANGOLO DI PARTENZA"},
      {"Q261", "MESSHOEHE", "SICHERHEITS-ABST."},
      {"Q320", "SICHERHEITS-ABST.", "SICHERE HOEHE"},
      {"Q320", "DISTANZA SICUREZZA", "ALTEZZA DI SICUREZZA"},
      {"Q260", "SICHERE HOEHE", "SICHERHEITS-ABST."},
      {"Q260", "VEILIGE HOOGTE", "VEILIGHEIDSAFSTAND"},
      {"Q275", "GROESSTMASS", "UNTERES ABMASS"},
      {"Q275", "UPPER LIMIT", "LIMITE INFERIORE"},
      {"Q276", "LOWER LIMIT", "UPPER LIMIT"},
      {"Q276", "ONDERGRENS", "BOVENGRENS"},
      {"Q279", "TOLERANZ 1. MITTE", "TOLERANZ 2. MITTE"},
      {"Q281", "MESSPROTOKOLL", "PGM-STOP BEI FEHLER"},
      {"Q309", "PGM STOP IF ERROR", "MEASURING LOG"},
  };
  for (const auto& [name, right, wrong] : comments) {
    CAPTURE(name);
    const auto commented = [&](std::string_view comment) {
      const auto at = kHole.find(std::string(name) + "=");
      const auto value = kHole.find(' ', at);
      const std::string rest = kHole.substr(kHole.find('\n', value));
      return "TCH PROBE 421 MEASURE HOLE ~\n " + kHole.substr(0, value) + " ;" +
             std::string(comment) + " ~" + rest;
    };
    CHECK_MESSAGE(!contradicts(commented(right), "cycle.comment_contradicts"), right);
    CHECK_MESSAGE(contradicts(commented(wrong), "cycle.comment_contradicts"), wrong);
  }
}

TEST_CASE("exchanged comments of neighbours are found in every cycle") {
  const auto block = [](const probing::CycleDescriptor& cycle, std::size_t exchanged) {
    std::string text =
        (cycle.family == probing::CycleFamily::TchProbe ? "TCH PROBE " : "CYCL DEF ") +
        std::to_string(cycle.number) + " " + std::string(cycle.name);
    for (std::size_t i = 0; i < cycle.parameters.size(); ++i) {
      const std::size_t said = i == exchanged ? i + 1 : i == exchanged + 1 ? i - 1 : i;
      text += " ~\n " + name(cycle.parameters[i]) + "=" +
              (cycle.parameters[i].is_text() ? "\"1\"" : "+Q1") + " ;" +
              ascii_upper(cycle.parameters[said].title());
    }
    return text;
  };
  std::size_t exchanges = 0;
  const auto check = [&](const probing::CycleDescriptor& cycle) {
    if (cycle.dotted || cycle.parameters.empty()) return;
    const auto count = [&](std::size_t exchanged) {
      return std::ranges::count_if(findings(block(cycle, exchanged)), [](const auto& found) {
        return found.ends_with("cycle.comment_contradicts");
      });
    };
    CHECK_MESSAGE(count(cycle.parameters.size()) == 0, block(cycle, cycle.parameters.size()));
    for (std::size_t i = 0; i + 1 < cycle.parameters.size(); ++i) {
      if (cycle.parameters[i].title() == cycle.parameters[i + 1].title()) continue;
      // `CLEARANCE HEIGHT` may be short for its mode.
      const int is_short = name(cycle.parameters[i + 1]) == "Q1125" ? 1 : 0;
      CHECK_MESSAGE(count(i) == 2 - is_short, block(cycle, i));
      ++exchanges;
    }
  };
  for (const auto* cycle : probing::cycles()) check(cycle->descriptor);
  for (const MachiningCycle& cycle : machining_cycles()) check(cycle.descriptor);
  CHECK(exchanges > 600);
}

/// Blocks in the words of controls: `TCH PROBE 421 MEASURE HOLE: Q273 CENTER IN 1ST AXIS|Q274 ...`.
std::vector<std::pair<std::string, std::vector<std::string>>> control_wording() {
  std::vector<std::pair<std::string, std::vector<std::string>>> cycles;
  std::ifstream in(FITGAUGE_SOURCE_DIR "/tests/unit/nc/run/control_wording.txt");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line.substr(line.find(": ") + 2));
    auto& cycle = cycles.emplace_back(line.substr(0, line.find(": ")), std::vector<std::string>());
    for (std::string word; std::getline(words, word, '|');) cycle.second.push_back(word);
  }
  return cycles;
}

TEST_CASE("exchanged comments in the words of controls are found, and no right one") {
  std::size_t exchanges = 0;
  std::vector<std::string> missed;
  for (auto& [head, words] : control_wording()) {
    const auto count = [&] {
      std::string text = head;
      for (const std::string& word : words)
        text +=
            " ~\n " + word.substr(0, word.find(' ')) + "=+Q1 ;" + word.substr(word.find(' ') + 1);
      return std::ranges::count_if(findings(text), [](const auto& found) {
        return found.ends_with("cycle.comment_contradicts");
      });
    };
    CHECK_MESSAGE(count() == 0, head);
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::string& one = words[i - 1];
      std::string& two = words[i];
      const auto exchange = [&] {
        const std::string name = one.substr(0, one.find(' '));
        const std::string other = two.substr(0, two.find(' '));
        const std::string said = one.substr(name.size());
        one = name + two.substr(other.size());
        two = other + said;
      };
      if (one.substr(one.find(' ')) == two.substr(two.find(' '))) continue;
      ++exchanges;
      exchange();
      if (count() == 0) missed.push_back(head + ": " + one + ", " + two);
      exchange();
    }
  }
  CHECK(exchanges > 800);
  // Two depths, a limit that is also a length, and MAX, which no other title has.
  CHECK(fmt::format("{}", fmt::join(missed, "\n")) ==
        "CYCL DEF 264 BOHRGEWINDEFRAESEN: Q201 BOHRTIEFE, Q356 GEWINDETIEFE\n"
        "CYCL DEF 264 THREAD DRILLNG/MLLNG: Q201 TOTAL HOLE DEPTH, Q356 DEPTH OF THREAD\n"
        "CYCL DEF 232 FACE MILLING: Q202 MAX. OVERLAP, Q370 MAX. PLUNGING DEPTH\n"
        "TCH PROBE 425 MESSEN BREITE INNEN: Q311 GROESSTMASS, Q288 SOLL-LAENGE");
}

TEST_CASE("parameters of another cycle name that cycle") {
  Control control;
  control.program(replaced(replaced(hole(), "Q275", "Q277"), "Q276", "Q278") + "TOOL CALL 0 Z");
  const auto found = control.diagnostics();
  REQUIRE(!found.empty());
  CHECK(found[0].message.find("those of cycle 422 MEAS. CIRCLE OUTSIDE") != std::string::npos);
}

TEST_CASE("no right program of the tree raises an alarm") {
  namespace fs = std::filesystem;
  std::size_t programs = 0;
  for (const char* folder : {"/clients/nc", "/tests/golden/nc"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(std::string(FITGAUGE_SOURCE_DIR) + folder)) {
      const std::string path = entry.path().string();
      if (entry.path().extension() != ".h" || path.find("/bad/") != path.npos) continue;
      Control control;
      control.file("main.h", content_of(path));
      ++programs;
      for (const auto& found : control.diagnostics()) {
        const std::string_view code = id(found.code);
        const bool is_alarm = code.ends_with("_contradicts") || code == "cycle.stylus_missing" ||
                              code == "parameter.result_unset" ||
                              code == "block.continuation_missing";
        CHECK_MESSAGE(!is_alarm, render(found));
      }
    }
  }
  CHECK(programs > 50);
}

}  // namespace
}  // namespace fitgauge::interpreter

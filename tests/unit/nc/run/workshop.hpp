#pragma once

#include "run_fixture.hpp"

namespace fitgauge::interpreter {

/// A control with a cutter 5 of radius 4 over X+10 Y+10 Z+50, where each body begins.
class Workshop : public Control {
 public:
  Workshop() {
    machine::ToolSetup cutter;
    cutter.row = {.number = 5, .name = "MILL", .l = 100, .r = 4};
    cutter.row.teeth = 2;
    setup.machine.tools.push_back(cutter);
  }

  /// What the machine does after that, without trailing zeros and without the words that stay.
  Lines path(const std::string& body) {
    program("TOOL CALL 5 Z S1000 F500\nL X+10 Y+10 Z+50 R0 FMAX\n" + body);
    last = run();
    Lines moves;
    for (std::string line : machine->lines()) {
      if (!line.starts_with("L ") && !line.starts_with("ARC ") && !line.starts_with("DWELL")) {
        continue;
      }
      for (auto at = line.find(".0000"); at != std::string::npos; at = line.find(".0000")) {
        line.erase(at, 5);
      }
      moves.push_back(std::move(line));
    }
    if (!moves.empty()) moves.erase(moves.begin());
    return moves;
  }
  /// The heights and feeds of a hole in X+10 Y+10.
  Lines hole(const std::string& body) {
    Lines moves = path(body + "\nCYCL CALL");
    for (std::string& line : moves) {
      if (const auto at = line.find("X+10 Y+10 "); at != std::string::npos) line.erase(at, 10);
    }
    return moves;
  }

  RunResult last;
};

}  // namespace fitgauge::interpreter

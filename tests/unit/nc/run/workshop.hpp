#pragma once

#include "run_fixture.hpp"

namespace fitgauge::interpreter {

/// A control with a cutter 5 of radius 4 over X+10 Y+10 Z+50, where each body begins.
class Workshop : public Control {
 public:
  Workshop() { add_cutter(); }

  /// What the machine does after that, without trailing zeros and without the words that stay.
  Lines path(const std::string& body) {
    program("TOOL CALL 5 Z S1000 F500\nL X+10 Y+10 Z+50 R0 FMAX\n" + body);
    last = run();
    Lines moves = traced_lines({"L ", "ARC ", "DWELL"}, {".0000"});
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

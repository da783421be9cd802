#pragma once

#include "nc/machine/machine_setup.hpp"
#include "nc/run/interpreter.hpp"

namespace fitgauge::interpreter::golden {

/// What a case runs on, from its setup.txt.
struct CaseSetup {
  machine::Setup machine;
  RunOptions options;
  bool live_tables = false;
  bool trace = false;
};

/// Reads the lines that README.md lists; throws std::runtime_error with the line it cannot read.
CaseSetup read_setup(const std::string& text);

}  // namespace fitgauge::interpreter::golden

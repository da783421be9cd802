#pragma once

#include <string>
#include <vector>

#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// What is wrong with a BLK FORM 0.1 or 0.2 and its other corner. Empty for other blocks.
std::vector<std::string> blank_faults(const klartext::Program& program,
                                      const klartext::Block& block);

}  // namespace fitgauge::interpreter

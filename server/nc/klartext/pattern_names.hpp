#pragma once

#include <string_view>

/// How the elements of PATTERN DEF are spelled, in the order of PatternElement.
namespace fitgauge::klartext {

inline constexpr std::string_view kPatternElements[] = {"POS",   "ROW",  "PAT",
                                                        "FRAME", "CIRC", "PITCHCIRC"};

}  // namespace fitgauge::klartext

#pragma once

#include <optional>
#include <string_view>

#include "nc/klartext/lexer.hpp"
#include "nc/klartext/statement.hpp"

/// How statements are spelled, each list in the order of its enumeration; the parser and the
/// printer share it.
namespace fitgauge::klartext {

inline constexpr std::string_view kPaths[] = {
#define FITGAUGE_PATH(path, spelling, words) spelling,
#include "nc/klartext/paths.inc"
#undef FITGAUGE_PATH
};

inline constexpr std::string_view kPlaneKinds[] = {"SPATIAL", "PROJECTED", "EULER", "VECTOR",
                                                   "POINTS",  "RELATIV",   "AXIAL", "RESET"};
inline constexpr std::string_view kPlanePositionings[] = {"", "TURN", "MOVE", "STAY"};
inline constexpr std::string_view kOperatingModes[] = {"MILL", "TURN", "GRIND"};
inline constexpr std::string_view kPatternElements[] = {"POS",   "ROW",  "PAT",
                                                        "FRAME", "CIRC", "PITCHCIRC"};

/// The value of an enumeration whose name is the next word.
template <class Enumeration, std::size_t N>
std::optional<Enumeration> accept_name(Lexer& in, const std::string_view (&names)[N]) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!names[i].empty() && in.accept_word(names[i])) return static_cast<Enumeration>(i);
  }
  return std::nullopt;
}

}  // namespace fitgauge::klartext

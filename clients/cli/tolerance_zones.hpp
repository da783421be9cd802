#pragma once

#include "base/length.hpp"
#include "cli/terminal.hpp"

namespace fitgauge::cli {

/// A tolerance interval about the zero line, the nominal size (ISO 286-1, 3.2.8).
struct ToleranceZone {
  std::string heading;     ///< `hole H7`
  std::string upper_name;  ///< ES or es
  std::string lower_name;  ///< EI or ei
  Length upper;
  Length lower;
  Colour colour = Colour::Cyan;
};

/// Draws the zones next to each other, larger sizes above, each with its deviations in µm. Every
/// zone is visible, however thin; with block characters the edges are drawn to half a line.
/// @param zero_line label at the end of the zero line: the nominal size
/// @param rows approximate number of lines for the zones
std::string draw_zones(std::span<const ToleranceZone> zones, const std::string& zero_line,
                       const Terminal& terminal, std::size_t rows = 14);

}  // namespace fitgauge::cli

#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/probing/cycle_descriptor.hpp"

/// The machining cycles, for the linker, /v1/cycles and the run. They run as motion of the tool:
/// positions, depths and feeds as on the control; no material is removed.
namespace fitgauge::interpreter {

/// The path of a machining cycle.
enum class MachiningShape : std::uint8_t {
  Drilling,           ///< 200, 201, 203, 205, 240, 241 and 1: down and up the tool axis
  Boring,             ///< 202: drilling with a withdrawal at the bottom
  BackBoring,         ///< 204
  Tapping,            ///< 2, 17, 18, 206, 207, 209: up again at the feed of the thread
  BoreMilling,        ///< 208: a helix
  RectangularPocket,  ///< 4, 251
  CircularPocket,     ///< 5, 252
  Slot,               ///< 3, 253
  CircularSlot,       ///< 254
  RectangularStud,    ///< 256
  CircularStud,       ///< 257
  FaceMilling,        ///< 232
  ThreadMilling,      ///< 262 to 267
  Engraving,          ///< 225
  PolarPattern,       ///< 220: runs the cycle before it at each of its points
  LinearPattern,      ///< 221
  ContourLabels,      ///< 14
  ContourData,        ///< 20
  Contour             ///< 21 to 24
};

struct MachiningCycle {
  probing::CycleDescriptor descriptor;
  MachiningShape shape;
  bool runs_when_defined = false;  ///< DEF-active; the others wait for M99, M89 or CYCL CALL
};

/// All of them, by number.
std::span<const MachiningCycle> machining_cycles();

/// Values with which a cycle cannot run.
struct CycleContradiction {
  int error = 0;      ///< of the control's list
  int parameter = 0;  ///< `Q424`
  int other = 0;      ///< the parameter that it contradicts; itself if it is wrong alone
  std::string text{};
};

/// A depth above the surface, which a control refuses with displayDepthErr.
inline constexpr int kDepthPositive = 1077;
inline constexpr std::string_view kDepthNeeds = "must have a minus";

/// The first contradiction between the known values of a cycle. @param value of a parameter, or
/// nothing if it is unknown
std::optional<CycleContradiction> contradiction(
    int cycle, const std::function<std::optional<double>(int)>& value);

/// `CYCL DEF` of that number, or null.
const MachiningCycle* machining_cycle(int number);

}  // namespace fitgauge::interpreter

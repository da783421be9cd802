#pragma once

#include "nc/probing/cycles.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::interpreter {

using probing::Arguments, probing::ArgumentValue, probing::CycleDescriptor, probing::CycleParameter,
    probing::find_cycle, probing::ParameterId, probing::TouchProbeCycle;

// The machining cycles, for the linker, /v1/cycles and the run. They run as motion of the tool:
// positions, depths and feeds as on the control; no material is removed.

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
  CycleDescriptor descriptor;
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

/// A cycle block in Q parameters, with its cycle and parameters already found, so that a run
/// searches nothing by name. Has at most one of the cycles; none: it is unavailable.
struct BoundCycle {
  const TouchProbeCycle* probing = nullptr;
  const MachiningCycle* machining = nullptr;
  const CycleDescriptor* global = nullptr;  ///< GLOBAL DEF
  /// One for each parameter of the block; not null, since the linker refuses unknown ones.
  std::vector<const CycleParameter*> parameters{};

  /// Describes its parameters; null if it is not available.
  const CycleDescriptor* descriptor() const {
    if (probing != nullptr) return &probing->descriptor;
    return machining != nullptr ? &machining->descriptor : global;
  }
};

BoundCycle bind_cycle(const Program& program, const klartext::Cycle& cycle);

inline constexpr double kMillimetresPerInch = 25.4;

/// Returns the size of one unit of a cycle parameter in mm, degrees or mm/min: 25.4 for lengths of
/// an INCH program, 2.54 for its feeds (tenths of an inch a minute).
double scale_of(probing::Unit unit, bool is_inch);

/// Returns the value of a cycle parameter that is known before the program runs: a written number
/// or text. None for parameters, formulas and PREDEF.
std::optional<ArgumentValue> literal(const Program& program,
                                     const klartext::CycleParameter& written,
                                     const CycleParameter& parameter);

/// The descriptor's parameter that `Q262=` or `QS400=` of a block means, or null.
const CycleParameter* find_parameter(const CycleDescriptor& descriptor, QRef written);

/// Another cycle of the same family with that name, or null; of two that which is written alike.
const CycleDescriptor* other_cycle(const CycleDescriptor& cycle, std::string_view name);

/// The cycle that a block or a sub-line names, settings included, or null. GLOBAL DEF names no
/// probing cycle.
const CycleDescriptor* cycle_of(klartext::CycleFamily family, int number);

/// A setting in sub-lines, such as `CYCL DEF 7.0`, `7.1`: 7 to 13, 19, 26, 32; null for another.
const CycleDescriptor* dotted_setting(int number);

/// Whether a block of that cycle can run: cycles of the probing library, the coordinate
/// transformations written in sub-lines, and machining cycles as motion can.
bool is_available(klartext::CycleFamily family, int number, bool dotted);

/// GLOBAL DEF 100, 105, 110, 111, 120 and 125: the values of PREDEF (decision 23). Static data;
/// null for another number.
const CycleDescriptor* global_definition(int number);

/// The GLOBAL DEF with a value for `Q320=PREDEF`, or null if PREDEF is not allowed.
const CycleDescriptor* global_definition_of(int parameter);

}  // namespace fitgauge::interpreter

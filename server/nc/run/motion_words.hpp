#pragma once

#include "nc/klartext/syntax.hpp"
#include "nc/machine/machine.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// A number that may be relative to the end of the last block.
struct Coordinate {
  double value = 0;
  bool incremental = false;

  double after(double last) const { return incremental ? last + value : value; }
};

/// An M function with its words: `M140 MB50 F750`, `M128 F1000`.
struct MCall {
  int number = 0;
  std::optional<double> length{};        ///< MB, mm
  bool to_limit = false;                 ///< MB MAX
  std::optional<machine::Feed> feed{};   ///< of M140
  const ControlPath* program = nullptr;  ///< its replacement in the setup
};

/// The words of a positioning block as numbers, in mm, degrees and mm/min.
struct MotionWords {
  std::array<std::optional<Coordinate>, machine::kAxes> axes;
  std::optional<Coordinate> pr;
  std::optional<Coordinate> pa;
  std::optional<double> r;
  std::optional<double> len;
  std::optional<double> cca;
  std::optional<double> chamfer;
  std::optional<machine::Feed> feed;  ///< written in the block
  std::vector<MCall> m;

  bool names_axes() const;
  bool has_m(int number) const;
};

/// @errors an axis that the machine does not have, an unavailable M function; decision 18 applies
///   to coordinates, decision 3 to all others.
NcResult<MotionWords> read_words(Channel& channel, Slice<Word> words);

/// F, FMAX, FAUTO, FU or FZ as mm/min. @errors FT and FMAXT.
NcResult<machine::Feed> read_feed(Channel& channel, const Word& word);

/// The feed of a block: its word, which becomes modal unless it is FMAX, or the modal feed.
NcResult<machine::Feed> use_feed(Channel& channel, const std::optional<machine::Feed>& written);

/// Moves along one positioning block, or keeps what its next blocks decide.
NcResult<void> position(Channel& channel, const klartext::Motion& motion, const MotionWords& words);

/// @errors AxisMissing for U, V, W, which the simulated machine does not have.
NcResult<machine::Axis> machine_axis(Letter letter);

/// A, B and C as spatial angles of the tool (FUNCTION TCPM AXIS SPAT), each as it was programmed
/// last.
using SpatialAngles = std::array<std::optional<double>, 3>;

/// Returns the positions turned by whole turns into the ranges of the axes, each nearest to `from`.
std::optional<machine::Vec3> in_range(const machine::MachineState& state, machine::Vec3 rotary,
                                      const machine::Vec3& from);

/// Positions of the rotary axes that point the tool along `normal`, a unit vector fixed to the
/// table: in their ranges and the nearest to `from`, in machine coordinates.
std::optional<machine::Vec3> rotary_along(const machine::MachineState& state,
                                          const machine::Vec3& normal, const machine::Vec3& from);

/// TX TY TZ or NX NY NZ of an LN block, by their first letter. @errors it has no length.
NcResult<std::optional<machine::Vec3>> vector_of(Channel& channel, const klartext::Motion& motion,
                                                 Letter first);

/// Adds the positions of the rotary axes to a block that defines the tool's direction in the input
/// system: LN by its tool vector, else by its normal, any line by spatial angles. Of the positions
/// in the range of the axes the nearest is used.
/// @errors 1013 no position of the axes reaches it; a vector without length; the first block under
///   AXIS SPAT that turns the tool omits an angle.
NcResult<void> orient_tool(Channel& channel, const klartext::Motion& motion, MotionWords& words);

}  // namespace fitgauge::interpreter

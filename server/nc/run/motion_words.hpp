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
NcResult<MotionWords> read_words(Channel& channel, klartext::Slice<klartext::Word> words);

/// F, FMAX, FAUTO, FU or FZ as mm/min. @errors FT and FMAXT.
NcResult<machine::Feed> read_feed(Channel& channel, const klartext::Word& word);

/// The feed of a block: its word, which becomes modal unless it is FMAX, or the modal feed.
NcResult<machine::Feed> use_feed(Channel& channel, const std::optional<machine::Feed>& written);

/// Moves along one positioning block, or keeps what its next blocks decide.
NcResult<void> position(Channel& channel, const klartext::Motion& motion, const MotionWords& words);

/// @errors AxisMissing for U, V, W, which the simulated machine does not have.
NcResult<machine::Axis> machine_axis(klartext::Letter letter);

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/run/run_result.hpp"

namespace fitgauge::klartext {
struct Block;
}

namespace fitgauge::interpreter {

class CallStack;
class LinkedProgram;
class QParameters;
class RunFiles;

/// A block of a running program.
struct Place {
  const LinkedProgram* program = nullptr;
  std::uint32_t index = 0;  ///< of the block

  std::string_view path() const;
  std::uint32_t line() const;
  /// Its number, as written or counted.
  std::uint32_t block() const;
  const klartext::Block& source() const;
};

/// An observer of a run; called on the run's thread, so it must not block.
class RunObserver {
 public:
  RunObserver& operator=(RunObserver&&) = delete;  // neither copied nor moved
  virtual ~RunObserver() = default;

  /// Asked once at the start: true if `entered` is needed for every block, false if only for blocks
  /// that may command the machine or print.
  virtual bool follows_every_block() const { return false; }
  /// Called once before the first block with the run's files, parameters and calls, which may be
  /// read in the calls below.
  virtual void begins(const RunFiles&, const QParameters&, const CallStack&) {}
  /// Called before a block: machine commands until the next call belong to it.
  virtual void entered(const Place&) {}
  /// The cycle that commands the machine from now on; 0: the blocks themselves.
  virtual void moved_by_cycle(int /*number*/) {}
  /// Now and then, with the blocks executed so far.
  virtual void progressed(std::uint64_t /*blocks*/) {}
  virtual void printed(std::string_view /*screen_line*/) {}
  virtual void reported(const RunMessage&) {}
  /// The run is over and its files are closed; the last call, and the files are still there.
  virtual void ends() {}
};

}  // namespace fitgauge::interpreter

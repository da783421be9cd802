#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace fitgauge::interpreter {

/// What one run may use. Beyond any of these it ends with LimitExceeded, but for the two depths,
/// which are the control's own (error 1025).
struct RunLimits {
  std::uint64_t blocks = 1'000'000;
  std::chrono::duration<double> time{10.0};         ///< of the wall clock
  std::size_t label_depth = 19;                     ///< subprograms nested by CALL LBL
  std::size_t program_depth = 19;                   ///< programs nested by CALL PGM
  std::size_t output_bytes = std::size_t{4} << 20;  ///< screen, files, messages and records
  std::size_t files = 100;                          ///< written
  /// All that the run holds: programs, tables, masks, presets, files, records, its trace.
  std::size_t memory_bytes = std::size_t{48} << 20;
};

}  // namespace fitgauge::interpreter

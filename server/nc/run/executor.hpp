#pragma once

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {

/// End of a run's code.
struct Ending {
  std::uint64_t blocks_executed = 0;
  std::optional<NcError> error;  ///< nothing when the program ended
};

/// Runs the main program of a channel to its end. If it fails, `channel.place()` is the block.
Ending execute_program(Channel& channel);

/// Runs the blocks from the instruction of a label to its LBL 0, for a cycle that needs a
/// subprogram. @errors those of the blocks; LBL 0 is missing.
NcResult<void> execute_label(Channel& channel, std::uint32_t label);

}  // namespace fitgauge::interpreter

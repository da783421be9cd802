#pragma once

#include "run/channel.hpp"

namespace fitgauge::interpreter {

/// How the code of a run came to its end.
struct Ending {
  std::uint64_t blocks_executed = 0;
  std::optional<NcError> error;  ///< nothing when the program ended
};

/// Runs the main program of a channel to its end. Where it fails, `channel.place()` is the block.
Ending execute_program(Channel& channel);

}  // namespace fitgauge::interpreter

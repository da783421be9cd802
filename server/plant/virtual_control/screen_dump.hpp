#pragma once

#include <string>

#include "plant/lsv2/link/answers.hpp"

namespace fitgauge::virtual_control {

/// A bitmap (BMP) of 640 by 480: the simulation has no screen, so it is one colour, that of the
/// program's state: green runs, red failed, grey else.
std::string screen_dump(control_link::ProgramState state);

}  // namespace fitgauge::virtual_control

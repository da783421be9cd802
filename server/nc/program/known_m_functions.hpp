#pragma once

namespace fitgauge::interpreter {

/// Whether the M function is one of the control's; what a machine builder adds is not available.
bool is_m_function(int number);

}  // namespace fitgauge::interpreter

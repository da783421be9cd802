#pragma once

#include <string>

/// What a check and a run say of an M function or cycle that is not the control's: which member of
/// the setup makes it known.
namespace fitgauge::interpreter {

std::string m_function_hint(int number);
std::string cycle_hint(bool is_probing, int number);

}  // namespace fitgauge::interpreter

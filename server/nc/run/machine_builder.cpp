#include "nc/run/machine_builder.hpp"

#include "nc/program/builder_hint.hpp"

namespace fitgauge::interpreter {

NcError unknown_m_function(int number) { return nc_error(m_function_hint(number)); }

NcError unknown_cycle(bool is_probing, int number) {
  return nc_error(cycle_hint(is_probing, number));
}

}  // namespace fitgauge::interpreter

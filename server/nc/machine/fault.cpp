#include "nc/machine/fault.hpp"

namespace fitgauge::machine {

MachineFault make_fault(FaultKind kind, std::string_view detail) {
  MachineFault fault{kind, 0, "Machine fault"};
  switch (kind) {
#define FITGAUGE_FAULT(known, number, text) \
  case FaultKind::known:                    \
    fault = {kind, number, text};           \
    break;
#include "nc/machine/fault_kinds.inc"
#undef FITGAUGE_FAULT
    default: break;
  }
  if (!detail.empty()) fault.text += fmt::format(": {}", detail);
  return fault;
}

void throw_bad_machine_result(const MachineFault& fault) {
  throw std::logic_error(
      fmt::format("value of a failed command of the control was read: {}", fault.text));
}

}  // namespace fitgauge::machine

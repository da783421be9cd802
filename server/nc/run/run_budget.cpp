#include "nc/run/run_budget.hpp"

namespace fitgauge::interpreter {

NcResult<std::int64_t> RunBudget::refuel(std::int64_t left, std::int64_t needed) {
  give_back(left);
  TRY(check());
  const auto remaining = static_cast<std::int64_t>(limits_.blocks - granted_);
  if (needed > remaining) {
    return limit_error("the run has executed its limit of {} blocks", limits_.blocks);
  }
  const std::int64_t portion = std::min(remaining, std::max(needed, kPortion));
  granted_ += static_cast<std::uint64_t>(portion);
  return portion;
}

std::optional<NcError> RunBudget::refusal() const {
  switch (allowance_.found()) {
    case Allowance::Spent::Nothing: break;
    case Allowance::Spent::Stop: return NcError{FaultKind::Cancelled, 0, "the run was cancelled"};
    case Allowance::Spent::Time:
      return limit_error("the run has taken its limit of {} seconds", limits_.time.count());
    case Allowance::Spent::Memory:
      return limit_error("the run has taken more than its {} bytes of memory",
                         limits_.memory_bytes);
  }
  return std::nullopt;
}

}  // namespace fitgauge::interpreter

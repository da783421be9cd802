#include "nc/probing/cycle_errors.hpp"

namespace fitgauge::probing {
namespace {

bool is_limited(const ValueRange& range) {
  const ValueRange any;
  return range.min != any.min || range.max != any.max;
}

}  // namespace

std::set<int> errors_of(const CycleDescriptor& cycle) {
  std::set<int> errors;
  for (const CycleParameter& parameter : cycle.parameters) {
    if (is_limited(parameter.range)) errors.insert(1004);
    if (parameter.kind == ValueKind::Whole && !cycle.dotted) errors.insert(1011);
  }
  for (int number = ErrorSet::kFirst; number <= ErrorSet::kLast; ++number) {
    if (cycle.errors.contains(number)) errors.insert(number);
  }
  return errors;
}

}  // namespace fitgauge::probing

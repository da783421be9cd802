#pragma once

#include <map>
#include <utility>

#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// A number, and where it is written.
struct FollowedValue {
  double value = 0;
  klartext::Slice<char> place{};
  const klartext::Block* block = nullptr;
};

/// Parameters that are a number on every way to the block that a walk has reached.
class FollowedValues {
 public:
  void clear() { values_.clear(); }
  void forget(klartext::QSpace space, std::size_t number) { values_.erase({space, number}); }
  void set(klartext::QRef parameter, const FollowedValue& value) {
    values_[{parameter.space, parameter.number}] = value;
  }

  /// Returns the parameters of a cycle that are numbers there, by parameter number.
  std::map<int, FollowedValue> known(const klartext::Program& program, const klartext::Cycle& cycle,
                                     const klartext::Block* block) const {
    std::map<int, FollowedValue> all;
    for (const auto& written : program.view(cycle.parameters)) {
      if (written.kind != klartext::CycleValue::Expression) continue;
      if (const auto* number = std::get_if<double>(&written.value))
        all[written.parameter.number] = {*number, written.written, block};
      const auto* parameter = std::get_if<klartext::QRef>(&written.value);
      if (parameter == nullptr) continue;
      const auto found = values_.find({parameter->space, parameter->number});
      if (found != values_.end()) all[written.parameter.number] = found->second;
    }
    return all;
  }

 private:
  std::map<std::pair<klartext::QSpace, std::size_t>, FollowedValue> values_;
};

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/probing/cycle_descriptor.hpp"
#include "nc/probing/cycle_fault.hpp"

namespace fitgauge::probing {

/// The value of a cycle parameter in a run: nothing, a number (mm, degrees, mm/min) or a text.
using ArgumentValue = std::variant<std::monostate, double, std::string>;

/// Checks if a value is allowed in a parameter, in the linker when it is known, and in the run. The
/// message has the parameter, the value and the allowed values.
/// @errors 1004 outside the range, 1011 not whole, not finite, or an unexpected text, 1017 missing.
CycleResult<void> check(const CycleParameter& parameter, const ArgumentValue& value);

/// The values of one cycle block, in the order of its descriptor's parameters.
class Arguments {
 public:
  explicit Arguments(const CycleDescriptor& descriptor)
      : descriptor_(&descriptor), values_(descriptor.parameters.size()) {}

  const CycleDescriptor& descriptor() const { return *descriptor_; }

  /// @pre `id` is a parameter of the cycle.
  void set(ParameterId id, ArgumentValue value);

  /// Puts the defaults into missing parameters and checks all; errors as `check`.
  CycleResult<void> complete();

  /// @pre complete() succeeded and the parameter is a number.
  double number(ParameterId id) const;
  double number(int parameter) const { return number(q(parameter)); }
  /// Returns the number of a cycle that is written in sub-lines or in Q parameters.
  double number(ParameterId word, int parameter) const {
    return number(descriptor_->dotted ? word : q(parameter));
  }
  /// The number of a parameter that not every cycle has.
  double number_or(int parameter, double fallback) const;
  int whole(int parameter) const { return static_cast<int>(number(parameter)); }
  bool has_number(ParameterId id) const;
  /// The text, or nothing if the parameter is not a text.
  const std::string* text(ParameterId id) const;

 private:
  std::size_t index(ParameterId id) const;

  const CycleDescriptor* descriptor_;
  std::vector<ArgumentValue> values_;
};

}  // namespace fitgauge::probing

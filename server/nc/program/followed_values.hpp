#pragma once

#include "nc/program/diagnose.hpp"

namespace fitgauge::interpreter {

/// A number, and where it is written.
struct FollowedValue {
  double value = 0;
  Slice<char> place{};
  const klartext::Block* block = nullptr;
};

/// Parameters that are a number on every way to the block that a walk has reached.
class FollowedValues {
 public:
  void clear() { values_.clear(); }
  void forget(QSpace space, std::size_t number) { values_.erase({space, number}); }
  void set(QRef parameter, const FollowedValue& value) {
    values_[{parameter.space, parameter.number}] = value;
  }

  /// Returns the parameters of a cycle that are numbers there, by parameter number.
  std::map<int, FollowedValue> known(const Program& program, const klartext::Cycle& cycle,
                                     const klartext::Block* block) const {
    std::map<int, FollowedValue> all;
    for (const auto& written : program.view(cycle.parameters)) {
      if (written.kind != klartext::CycleValue::Expression) continue;
      auto found = value_of(program, written.value);
      if (found && found->block == nullptr) found = {found->value, written.written, block};
      if (found) all[written.parameter.number] = *found;
    }
    return all;
  }

  /// Returns an expression of numbers and of parameters that are numbers, with the place of the
  /// last of these parameters; no block if there is none.
  std::optional<FollowedValue> value_of(const Program& program, const Expr& value) const {
    if (const auto* number = std::get_if<double>(&value)) return FollowedValue{*number};
    if (const auto* parameter = std::get_if<QRef>(&value)) {
      const auto found = values_.find({parameter->space, parameter->number});
      return found == values_.end() ? std::nullopt : std::optional(found->second);
    }
    const auto* index = std::get_if<NodeIndex>(&value);
    if (index == nullptr || !is_arithmetic(program.node(*index).op)) return std::nullopt;
    FollowedValue result;
    std::array<double, 2> operands{};
    std::size_t count = 0;
    for (const Expr& operand : program.operands(*index)) {
      const auto found = value_of(program, operand);
      if (!found) return std::nullopt;
      if (found->block != nullptr && found->block >= result.block) result = *found;
      operands.at(count++) = found->value;
    }
    result.value = compute(program.node(*index).op, operands[0], operands[1]);
    return std::isfinite(result.value) ? std::optional(result) : std::nullopt;
  }

 private:
  std::map<std::pair<QSpace, std::size_t>, FollowedValue> values_;
};

/// The written number that a value is: none of `Q201=-Q5` and `Q5 = 20`.
inline std::optional<DiagnosticEdit> written_value(const Program& program,
                                                   const FollowedValue& followed) {
  auto written = written_number(program, followed.place);
  if (!written) return written;
  std::string text = written->by.substr(written->by.starts_with('+') ? 1 : 0);
  std::ranges::replace(text, ',', '.');
  return read_number<double>(text) == followed.value ? written : std::nullopt;
}

/// Whether the cycle alone reads the parameter with a value: it is written twice in the program.
inline bool is_read_once(const Program& program, const FollowedValue& followed) {
  const auto* source = followed.block->as<klartext::Assignment>();
  if (source == nullptr) return true;
  std::size_t count = 0;
  for (const klartext::Block& block : program.blocks()) {
    count += places_of(program, block.written, source->target).size();
    if (count > 2) return false;
  }
  return true;
}

}  // namespace fitgauge::interpreter

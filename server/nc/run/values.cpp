#include "nc/run/values.hpp"

#include "nc/program/arithmetic.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/tool_values.hpp"

namespace fitgauge::interpreter {

using klartext::Expr;
using klartext::NodeIndex;
using klartext::Operator;
using klartext::QRef;
using klartext::Text;

namespace {

bool is_string(const Channel& channel, const Expr& expr) {
  const auto* node = std::get_if<NodeIndex>(&expr);
  return node != nullptr ? gives_text(channel.program().node(*node).op) : is_text(expr);
}

NcResult<double> arithmetic(Channel& channel, NodeIndex index) {
  const auto operands = channel.program().operands(index);
  double values[2] = {0, 0};
  for (std::size_t i = 0; i < operands.size() && i < 2; ++i)
    values[i] = TRY(number(channel, operands[i]));
  const Operator op = channel.program().node(index).op;
  const double result = compute(op, values[0], values[1]);
  if (!std::isfinite(result)) return nc_error(failure(op, values[0], values[1]));
  return result;
}

}  // namespace

NcResult<double> number(Channel& channel, const Expr& expr) {
  if (const auto* literal = std::get_if<double>(&expr)) return *literal;
  if (const auto* node = std::get_if<NodeIndex>(&expr)) return evaluate(channel, *node);
  const auto* parameter = std::get_if<QRef>(&expr);
  if (parameter == nullptr || parameter->is_string()) {
    return nc_error("a number is needed here, not a text");
  }
  auto value = channel.parameters.number(*parameter);
  if (!value && is_preassigned(cell_of(*parameter))) {
    update_preassigned(channel);
    value = channel.parameters.number(*parameter);
  }
  if (!value) return undefined_error(*parameter);
  return *value;
}

NcResult<std::optional<double>> coordinate(Channel& channel, const Expr& expr) {
  const Expr* operand = &expr;
  if (const auto* node = std::get_if<NodeIndex>(&expr);
      node != nullptr && channel.program().node(*node).op == Operator::Minus) {
    operand = &channel.program().operands(*node)[0];
  }
  if (const auto* parameter = std::get_if<QRef>(operand);
      parameter != nullptr && !channel.parameters.is_defined(*parameter) &&
      !is_preassigned(cell_of(*parameter))) {
    return std::optional<double>();
  }
  const auto value = TRY(number(channel, expr));
  return std::optional(value);
}

NcResult<int> whole_in(Channel& channel, const Expr& expr, int least, int most) {
  const auto value = TRY(number(channel, expr));
  if (value != std::nearbyint(value)) return nc_error(1011, "{} is not a whole number", value);
  if (value < least || value > most)
    return nc_error(1011, "{} is outside of {} to {}", value, least, most);
  return static_cast<int>(value);
}

NcResult<int> whole(Channel& channel, const Expr& expr) {
  return whole_in(channel, expr, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

NcResult<std::string> text(Channel& channel, const Expr& expr) {
  if (const auto* literal = std::get_if<Text>(&expr)) {
    return std::string(channel.program().text(*literal));
  }
  if (const auto* parameter = std::get_if<QRef>(&expr);
      parameter != nullptr && parameter->is_string()) {
    const std::string* value = channel.parameters.string(parameter->number);
    if (value == nullptr) return undefined_error(*parameter);
    return *value;
  }
  if (const auto* node = std::get_if<NodeIndex>(&expr)) return string_value(channel, *node);
  return nc_error("a text is needed here, not a number");
}

NcResult<double> evaluate(Channel& channel, NodeIndex index) {
  const Operator op = channel.program().node(index).op;
  if (is_arithmetic(op)) return arithmetic(channel, index);
  if (op == Operator::SystemRead) return read_system_data(channel, index);
  return string_number(channel, index);
}

NcResult<bool> condition(Channel& channel, NodeIndex index) {
  const Operator op = channel.program().node(index).op;
  const auto operands = channel.program().operands(index);
  if (op == Operator::IsDefined || op == Operator::IsUndefined) {
    const bool defined = channel.parameters.is_defined(std::get<QRef>(operands[0]));
    return defined == (op == Operator::IsDefined);
  }
  if (is_string(channel, operands[0]) || is_string(channel, operands[1])) {
    const auto a = TRY(text(channel, operands[0]));
    const auto b = TRY(text(channel, operands[1]));
    if (op == Operator::Equal) return a == b;
    if (op == Operator::NotEqual) return a != b;
    return nc_error("texts can be compared with EQU and NE only");
  }
  const auto a = TRY(number(channel, operands[0]));
  const auto b = TRY(number(channel, operands[1]));
  switch (op) {
    case Operator::Equal: return are_equal(a, b);
    case Operator::NotEqual: return !are_equal(a, b);
    case Operator::Greater: return a > b;
    default: return a < b;
  }
}

}  // namespace fitgauge::interpreter

#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
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

/// A column that is a whole number from 0.
struct WholeColumn {
  std::int64_t nr;
  std::string_view name;
  int Tool::*value;
  int most;
};

constexpr WholeColumn kWholeColumns[] = {
    {8, "RT", &Tool::replacement, 32'767},
    {15, "CUT", &Tool::teeth, 1000},
    {36, "TYP", &Tool::type, 999},
};

template <class Columns>
auto column(const Columns& columns, std::int64_t nr) {
  const auto* it = std::ranges::find_if(columns, [nr](const auto& each) { return each.nr == nr; });
  return nr == 0 || it == std::end(columns) ? nullptr : it;
}

template <class Columns>
std::int64_t number_of(const Columns& columns, std::string_view name) {
  const auto* it = std::ranges::find_if(
      columns, [&](const auto& entry) { return ascii_iequals(entry.name, name); });
  return it == std::end(columns) ? 0 : it->nr;
}

}  // namespace

NcResult<double> number(Channel& channel, const Expr& expr) {
  if (const auto* literal = std::get_if<double>(&expr)) return *literal;
  if (const auto* node = std::get_if<NodeIndex>(&expr)) return evaluate(channel, *node);
  const auto* parameter = std::get_if<QRef>(&expr);
  if (parameter == nullptr || parameter->is_string())
    return nc_error("a number is needed here, not a text");
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
  if (const auto* literal = std::get_if<Text>(&expr))
    return std::string(channel.program().text(*literal));
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

std::optional<double> tool_value(const Tool& tool, std::int64_t nr) {
  if (const machine::ToolColumn* plain = column(machine::kToolColumns, nr)) return tool.*plain->value;
  if (const WholeColumn* whole = column(kWholeColumns, nr)) return tool.*whole->value;
  switch (nr) {
    case 7: return tool.locked ? 1 : 0;
    case 18: return tool.clockwise ? 0 : 1;
    default: return std::nullopt;
  }
}

ToolWrite set_tool_value(Tool& tool, std::int64_t nr, double value) {
  if (const machine::ToolColumn* plain = column(machine::kToolColumns, nr)) {
    tool.*plain->value = value;
    return ToolWrite::Done;
  }
  if (const WholeColumn* whole = column(kWholeColumns, nr)) {
    if (!(value >= 0 && value <= whole->most) || value != std::floor(value))
      return ToolWrite::OutOfRange;
    tool.*whole->value = static_cast<int>(value);
    return ToolWrite::Done;
  }
  switch (nr) {
    case 7: tool.locked = value != 0; return ToolWrite::Done;
    case 18: tool.clockwise = value == 0; return ToolWrite::Done;
    default: return ToolWrite::Unknown;
  }
}

std::int64_t tool_column(std::string_view name) {
  const std::int64_t plain = number_of(machine::kToolColumns, name);
  return plain != 0 ? plain : number_of(kWholeColumns, name);
}

NcResult<void> note_lathe_value(Channel& channel, const Tool& tool, std::int64_t nr) {
  const auto* known = column(machine::kToolColumns, nr);
  const bool is_length =
      known != nullptr && (known->value == &Tool::l || known->value == &Tool::r ||
                           known->value == &Tool::dl || known->value == &Tool::dr);
  if (!tool.lathe || !is_length) return {};
  return channel.note(
      "tool {} is a lathe tool: {} has no effect, since ZL, XL, DZL and DXL are its lengths",
      tool.number, known->name);
}

bool is_tool_length(std::int64_t nr) {
  return nr < 8 || nr == 13 || (nr > 15 && nr < 28) || nr == 33;
}

void update_preassigned(Channel& channel) {
  const MachineState& state = channel.state();
  QParameters& q = channel.parameters;
  const bool is_inch = channel.calls.main_program().is_inch();
  const double unit = is_inch ? 25.4 : 1.0;
  q.set_q(108, state.tool_radius() / unit);
  q.set_q(109, state.tool.axis ? static_cast<double>(index(*state.tool.axis)) : -1);
  q.set_q(110, static_cast<int>(state.modes.spindle));
  q.set_q(111, state.modes.coolant ? 1 : 0);
  q.set_q(113, is_inch ? 1 : 0);
  q.set_q(114, state.tool_length() / unit);
}

void set_plane_angles(Channel& channel, const Vec3& rotary) {
  for (std::uint16_t i = 0; i < 3; ++i)
    channel.parameters.set_q(static_cast<std::uint16_t>(120 + i), rotary[i]);
}

}  // namespace fitgauge::interpreter

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

/// Formulas. The levels, from the loosest: `||`, `+ -`, `* / %`, `^` (right to left), functions,
/// the algebraic sign, and operands. The sign binds tighter than `^`: `- 2 ^ 2` is 4. A function
/// applies to the next operand only: `SIN 30 ^ 2` is the square of the sine.
namespace fitgauge::klartext {
namespace {

Expr parse_arguments(BlockReader& in, const StringFunction& function) {
  std::array<Expr, 3> arguments;
  in.expect('(');
  for (std::size_t i = 0; i < function.argument_count; ++i) {
    const StringArgument& argument = function.arguments[i];
    if (!in.accept_prefix(argument.prefix)) {
      if (argument.required) in.fail_expected(argument.prefix);
      continue;
    }
    arguments[i] = argument.string ? parse_string(in) : parse_number(in);
  }
  in.expect(')');
  return in.add_node(function.op, std::span(arguments).first(function.argument_count));
}

Expr parse_sum(BlockReader& in);
Expr parse_signed(BlockReader& in);

Expr negated(BlockReader& in, const Expr& operand) {
  if (const auto* number = std::get_if<double>(&operand)) return -*number;
  return in.add_node(Operator::Minus, {operand});
}

void require(BlockReader& in, const Expr& operand, bool string, const char* begin) {
  if (in.failure() || in.is_string(operand) == string) return;
  in.fail(DiagnosticCode::ParameterType, in.since(begin),
          string ? "a text is needed here: a QS parameter, a text in double quotes or TOCHAR"
                 : "a number is needed here: TONUMB makes one of a text");
}

/// The result of `read`, which must be a number or, for `string`, a text.
template <class Read>
Expr parse_typed(BlockReader& in, bool string, Read read) {
  const char* begin = in.skip_blanks();
  const Expr operand = read(in);
  require(in, operand, string, begin);
  return operand;
}

Expr parse_alone(BlockReader& in) {
  if (in.at_end()) return in.fail_expected("a value");
  if (in.at_number()) return in.number();
  if (in.at_parameter()) return in.parameter();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the text");
  if (in.accept('(')) {
    in.enter();
    const Expr inner = parse_formula(in);
    in.expect(')');
    in.leave();
    return inner;
  }
  if (in.accept_word("PI")) return in.add_node(Operator::Pi, {});
  for (const StringFunction& function : kStringFunctions) {
    if (in.accept_word(function.name)) return parse_arguments(in, function);
  }
  if (const auto op = accept_name(in, kFunctions, Operator::Sq)) {
    in.enter();
    const Expr argument = parse_typed(in, false, parse_signed);
    in.leave();
    return in.add_node(*op, {argument});
  }
  const char* begin = in.at();
  for (const std::string_view feature : {"CFGREAD", "TABDATA", "SQL"}) {
    if (in.accept_word(feature)) return in.refuse(begin, feature);
  }
  in.fail_expected("a number, a parameter, a function or '('");
  return Absent{};
}

Expr parse_signed(BlockReader& in) {
  if (in.accept('-')) return negated(in, parse_typed(in, false, parse_alone));
  if (in.accept('+')) return parse_typed(in, false, parse_alone);
  return parse_alone(in);
}

Expr parse_power(BlockReader& in) {
  const char* begin = in.skip_blanks();
  const Expr base = parse_signed(in);
  if (!in.accept('^')) return base;
  require(in, base, false, begin);
  in.enter();
  const Expr exponent = parse_typed(in, false, parse_power);
  in.leave();
  return in.add_node(Operator::Power, {base, exponent});
}

/// Operands of `next` joined from left to right by one of `operators`.
template <class Next>
Expr parse_chain(BlockReader& in, std::initializer_list<std::pair<char, Operator>> operators,
                 Next next) {
  const char* begin = in.skip_blanks();
  Expr left = next(in);
  for (bool more = true; more && !in.failure();) {
    more = false;
    for (const auto& [sign, op] : operators) {
      if (!in.accept(sign)) continue;
      require(in, left, false, begin);
      left = in.add_node(op, {left, parse_typed(in, false, next)});
      more = true;
      break;
    }
  }
  return left;
}

Expr parse_product(BlockReader& in) {
  return parse_chain(in,
                     {{'*', Operator::Multiply}, {'/', Operator::Divide}, {'%', Operator::Modulo}},
                     parse_power);
}

Expr parse_sum(BlockReader& in) {
  return parse_chain(in, {{'+', Operator::Add}, {'-', Operator::Subtract}}, parse_product);
}

}  // namespace

Expr parse_formula(BlockReader& in) {
  const char* begin = in.skip_blanks();
  Expr left = parse_sum(in);
  while (in.accept_word("||")) {
    require(in, left, true, begin);
    left = in.add_node(Operator::Concat, {left, parse_typed(in, true, parse_sum)});
  }
  return left;
}

Expr parse_value(BlockReader& in) {
  const char* begin = in.skip_blanks();
  const bool minus = in.peek() == '-';
  const bool has_sign = minus || in.peek() == '+';
  if (has_sign) {
    in.move_to(begin + 1);
    in.skip_blanks();
  }
  if (in.at_number()) {
    const double number = in.number();
    return minus ? -number : number;
  }
  if (!in.at_parameter()) return in.fail_expected("a number or a Q parameter");
  const QRef parameter = in.parameter();
  if (has_sign) require(in, parameter, false, begin);
  return minus ? negated(in, parameter) : Expr(parameter);
}

Expr parse_number(BlockReader& in) { return parse_typed(in, false, parse_value); }

Expr parse_string(BlockReader& in) {
  in.skip_blanks();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the text");
  return parse_typed(in, true, parse_value);
}

}  // namespace fitgauge::klartext

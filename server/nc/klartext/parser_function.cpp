#include "nc/klartext/forms.hpp"
#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

Statement parse_formula_of(BlockReader& in, QRef target, AssignmentForm form) {
  in.expect('=');
  in.skip_blanks();
  const char* begin = in.at();
  const Expr value = parse_formula(in);
  if (!in.failure() && in.is_string(value) != target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            target.is_string() ? "a QS parameter must have a text: TOCHAR converts a number"
                               : "this parameter takes a number: TONUMB makes one of a text");
  }
  return Assignment{.target = target, .form = form, .fn = 0, .value = value};
}

constexpr std::uint32_t kLargestFn = 39;

/// An operand of a comparison: a number, a parameter or a text.
Expr parse_comparable(BlockReader& in) {
  in.skip_blanks();
  return in.peek() == '"' ? parse_string(in) : parse_value(in);
}

/// The column names: `"X,Y"`, `QS1` or `:'QS1'`.
Expr parse_columns(BlockReader& in) {
  const bool marked = in.accept_word(":'");
  const Expr columns = parse_string(in);
  if (marked) in.expect('\'');
  return columns;
}

Statement parse_arithmetic(BlockReader& in, const ArithmeticFn& function) {
  const QRef target = parse_target(in);
  in.expect('=');
  const Expr first = function.unary ? Expr() : parse_number(in);
  in.expect_word(function.sign);
  const Expr second = parse_number(in);
  const Expr value = function.unary ? in.add_node(function.op, {second})
                                    : in.add_node(function.op, {first, second});
  return Assignment{.target = target,
                    .form = AssignmentForm::Fn,
                    .fn = static_cast<std::uint8_t>(function.fn),
                    .value = value};
}

Statement parse_fn_0(BlockReader& in) {
  in.skip_blanks();
  const QRef any = in.parameter();
  if (in.accept_word("SET")) {
    in.expect_word("UNDEFINED");
    return SetUndefined{any};
  }
  in.expect('=');
  if (!in.failure() && any.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.here(), "FN 0 assigns a number, not a text");
  }
  return Assignment{.target = any, .form = AssignmentForm::Fn, .fn = 0, .value = parse_number(in)};
}

Expr parse_definedness(BlockReader& in, const Expr& operand) {
  const bool parameter = std::holds_alternative<QRef>(operand);
  if (!parameter) in.fail_expected("a parameter before IS");
  if (in.accept_word("DEFINED")) return in.add_node(Operator::IsDefined, {operand});
  in.expect_word("UNDEFINED");
  return in.add_node(Operator::IsUndefined, {operand});
}

Statement parse_conditional_jump(BlockReader& in, unsigned fn) {
  constexpr unsigned kFirstComparison = 9;
  const FunctionName& comparison = kComparisons[fn - kFirstComparison];
  in.expect_word("IF");
  in.skip_blanks();
  const char* begin = in.at();
  const Expr left = parse_comparable(in);
  Expr condition;
  if (fn == kFirstComparison && in.accept_word("IS")) {
    condition = parse_definedness(in, left);
  } else {
    in.expect_word(comparison.name);
    const Expr right = parse_comparable(in);
    const bool texts = in.is_string(left);
    const bool ordered = comparison.op == Operator::Greater || comparison.op == Operator::Less;
    if (!in.failure() && (texts != in.is_string(right) || (texts && ordered))) {
      in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
              "both sides must be numbers, or both texts with EQU or NE");
    }
    condition = in.add_node(comparison.op, {left, right});
  }
  in.expect_word("GOTO");
  in.expect_prefix("LBL");
  return ConditionalJump{condition, parse_label(in)};
}

Statement parse_system_read(BlockReader& in) {
  in.expect_word("SYSREAD");
  const QRef target = parse_target(in);
  in.expect('=');
  return Assignment{.target = target,
                    .form = AssignmentForm::Fn,
                    .fn = 18,
                    .value = parse_system_address(in, Operator::SystemRead)};
}

}  // namespace

Statement parse_assignment(BlockReader& in) {
  const QRef target = in.parameter();
  return parse_formula_of(in, target, AssignmentForm::Formula);
}

Statement parse_declare(BlockReader& in) {
  if (!in.accept_word("STRING")) return refuse_word(in, "DECLARE");
  in.skip_blanks();
  const char* begin = in.at();
  const QRef target = in.parameter();
  if (!in.failure() && !target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            "DECLARE STRING needs a QS parameter");
  }
  return parse_formula_of(in, target, AssignmentForm::DeclareString);
}

QRef parse_target(BlockReader& in) {
  in.skip_blanks();
  const char* begin = in.at();
  const QRef target = in.parameter();
  if (!in.failure() && target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            "this function gives a number: name a Q, QL or QR parameter");
  }
  return target;
}

Slice<Expr> parse_items(BlockReader& in) {
  std::vector<Expr> items;
  do {
    items.push_back(parse_comparable(in));
  } while (in.accept('/'));
  return in.add_operands(items);
}

Expr parse_system_address(BlockReader& in, Operator op) {
  in.expect_prefix("ID");
  const Expr id = parse_number(in);
  in.expect_prefix("NR");
  const Expr number = parse_number(in);
  const Expr index = in.accept_prefix("IDX") ? parse_number(in) : Expr();
  return in.add_node(op, {id, number, index});
}

Expr parse_cell(BlockReader& in) {
  const Expr row = parse_number(in);
  in.expect('/');
  return in.add_node(Operator::TableCell, {row, parse_columns(in)});
}

Statement parse_fn(BlockReader& in) {
  in.skip_blanks();
  const char* begin = in.at();
  const std::uint32_t fn = in.digits(kLargestFn, "the number of the function");
  in.expect(':');
  if (const ArithmeticFn* function = find_arithmetic(fn)) return parse_arithmetic(in, *function);
  switch (fn) {
    case 0: return parse_fn_0(in);
    case 9:
    case 10:
    case 11:
    case 12: return parse_conditional_jump(in, fn);
    case 14: return read_form<ErrorStop>(in);
    case 15: return read_form<Print>(in);
    case 16: return read_form<FormattedPrint>(in);
    case 17: return read_form<SystemWrite>(in);
    case 18: return parse_system_read(in);
    case 19:
    case 29:
    case 37:
    case 38: return read_form(in, ExternalFunction{.fn = static_cast<std::uint8_t>(fn)});
    case 20: return read_form<WaitFor>(in);
    case 23:
    case 24: return read_form(in, CircleData{.points = static_cast<std::uint8_t>(fn - 20)});
    case 26: return read_form<TableOpen>(in);
    case 27: return read_form<TableWrite>(in);
    case 28: return read_form<TableRead>(in);
    default: in.refuse(begin, fmt::format("FN {}", fn)); return Empty{};
  }
}

}  // namespace fitgauge::klartext

#include <fmt/format.h>

#include <span>
#include <vector>

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kLargestFn = 39;

/// The parameter of a number that takes a result, and the `=` behind it.
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

/// An operand of a comparison: a number, a parameter or a text.
Expr parse_comparable(BlockReader& in) {
  in.skip_blanks();
  return in.peek() == '"' ? parse_string(in) : parse_value(in);
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
              "two numbers can be compared, or with EQU and NE two texts");
    }
    condition = in.add_node(comparison.op, {left, right});
  }
  in.expect_word("GOTO");
  in.expect_prefix("LBL");
  return ConditionalJump{condition, parse_label(in)};
}

/// Values separated by `/`, texts in double quotes among them.
Slice<Expr> parse_items(BlockReader& in) {
  std::vector<Expr> items;
  do {
    items.push_back(parse_comparable(in));
  } while (in.accept('/'));
  return in.add_operands(items);
}

Statement parse_external(BlockReader& in, unsigned fn, std::string_view keyword, char mark) {
  in.expect_word(keyword);
  if (mark == '=') in.expect('=');
  if (mark == '/') in.accept('/');
  return ExternalFunction{static_cast<std::uint8_t>(fn), parse_items(in)};
}

Statement parse_formatted_print(BlockReader& in) {
  in.expect_word("F-PRINT");
  const Expr mask = parse_path(in, '/');
  in.expect('/');
  return FormattedPrint{mask, parse_path(in)};
}

/// `ID50 NR4 IDXQ2`.
Expr parse_system_address(BlockReader& in, Operator op) {
  in.expect_prefix("ID");
  const Expr id = parse_number(in);
  in.expect_prefix("NR");
  const Expr number = parse_number(in);
  const Expr index = in.accept_prefix("IDX") ? parse_number(in) : Expr();
  return in.add_node(op, {id, number, index});
}

Statement parse_system_write(BlockReader& in) {
  in.expect_word("SYSWRITE");
  const Expr address = parse_system_address(in, Operator::SystemAddress);
  in.expect('=');
  return SystemWrite{address, parse_number(in)};
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

Statement parse_circle_data(BlockReader& in, unsigned fn) {
  const QRef target = parse_target(in);
  in.expect('=');
  in.expect_word("CDATA");
  const QRef first_point = parse_target(in);
  return CircleData{target, first_point, static_cast<std::uint8_t>(fn - 20)};
}

Statement parse_error_stop(BlockReader& in) {
  in.expect_word("ERROR");
  in.accept('=');
  return ErrorStop{parse_number(in)};
}

Statement parse_wait(BlockReader& in) {
  in.expect_word("WAIT");
  in.expect_word("FOR");
  return WaitFor{in.add_text(free_text(in.rest()))};
}

}  // namespace

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
    case 14: return parse_error_stop(in);
    case 15: in.expect_word("PRINT"); return Print{parse_items(in)};
    case 16: return parse_formatted_print(in);
    case 17: return parse_system_write(in);
    case 18: return parse_system_read(in);
    case 19:
    case 29: return parse_external(in, fn, "PLC", '=');
    case 20: return parse_wait(in);
    case 23:
    case 24: return parse_circle_data(in, fn);
    case 26:
    case 27:
    case 28: return parse_table_function(in, fn);
    case 37: return parse_external(in, fn, "EXPORT", ' ');
    case 38: return parse_external(in, fn, "SEND", '/');
    default: in.refuse(begin, fmt::format("FN {}", fn)); return Empty{};
  }
}

}  // namespace fitgauge::klartext

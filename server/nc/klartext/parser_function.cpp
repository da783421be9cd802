#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

Statement parse_formula_of(BlockReader& in, QRef target, AssignmentForm form) {
  in.expect('=');
  const char* begin = in.skip_blanks();
  const Expr value = parse_formula(in);
  if (!in.failure() && in.is_string(value) != target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.since(begin),
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
  if (!in.failure() && any.is_string())
    in.fail(DiagnosticCode::ParameterType, in.here(), "FN 0 assigns a number, not a text");
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
  const auto place = fn - kFirstComparison;
  const auto op = static_cast<Operator>(static_cast<unsigned>(Operator::Equal) + place);
  in.expect_word("IF");
  const char* begin = in.skip_blanks();
  const Expr left = parse_comparable(in);
  Expr condition;
  if (fn == kFirstComparison && in.accept_word("IS")) {
    condition = parse_definedness(in, left);
  } else {
    in.expect_word(kComparisons[place]);
    const Expr right = parse_comparable(in);
    const bool texts = in.is_string(left);
    const bool ordered = op == Operator::Greater || op == Operator::Less;
    if (!in.failure() && (texts != in.is_string(right) || (texts && ordered))) {
      in.fail(DiagnosticCode::ParameterType, in.since(begin),
              "both sides must be numbers, or both texts with EQU or NE");
    }
    condition = in.add_node(op, {left, right});
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

constexpr std::size_t kLongestLabelName = 32;

constexpr std::string_view kParameterMark = ":'";

/// Reads `QSn` and the characters behind it that must follow; the lexer is moved there.
Expr parse_embedded_parameter(BlockReader& in, const char* at, std::string_view close) {
  in.move_to(at);
  const char* begin = in.at();
  const QRef parameter = in.parameter();
  if (!in.failure() && !parameter.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.since(begin),
            "a file name must come from a QS parameter");
  }
  for (const char c : close) in.expect(c);
  return parameter;
}

/// The pieces of a bare path between `at` and `end`, joined.
Expr parse_path_pieces(BlockReader& in, const char* at, const char* end) {
  Expr path;
  const auto join = [&](const Expr& piece) {
    path = is_absent(path) ? piece : in.add_node(Operator::Concat, {path, piece});
  };
  while (at != end && !in.failure()) {
    const std::string_view rest(at, end);
    const std::size_t mark = std::min(rest.find(kParameterMark), rest.size());
    if (mark > 0) join(in.add_text(unwrapped(rest.substr(0, mark))));
    at += mark;
    if (at == end) break;
    join(parse_embedded_parameter(in, at + kParameterMark.size(), "'"));
    at = in.at();
  }
  if (!in.failure()) in.move_to(end);
  return path;
}

}  // namespace

Statement parse_assignment(BlockReader& in) {
  const QRef target = in.parameter();
  return parse_formula_of(in, target, AssignmentForm::Formula);
}

Statement parse_declare(BlockReader& in) {
  if (!in.accept_word("STRING")) return refuse_word(in, "DECLARE");
  const char* begin = in.skip_blanks();
  const QRef target = in.parameter();
  if (!in.failure() && !target.is_string())
    in.fail(DiagnosticCode::ParameterType, in.since(begin), "DECLARE STRING needs a QS parameter");
  return parse_formula_of(in, target, AssignmentForm::DeclareString);
}

QRef parse_target(BlockReader& in) {
  const char* begin = in.skip_blanks();
  const QRef target = in.parameter();
  if (!in.failure() && target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.since(begin),
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
  const char* begin = in.skip_blanks();
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
    default: return in.refuse(begin, fmt::format("FN {}", fn));
  }
}

Expr parse_path(BlockReader& in, char stop) {
  in.skip_blanks();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the file name");
  const std::string_view bare = in.rest_until(stop);
  if (bare.empty()) return in.fail_expected("a file name");
  const bool invalid = std::any_of(bare.begin(), bare.end(), [](char c) {
    return c == '"' || (static_cast<unsigned char>(c) < 0x20 && c != '\n');
  });
  if (invalid || bare.size() > kLongestString)
    return in.fail(DiagnosticCode::SyntaxError, in.place(bare.data(), bare.data() + bare.size()),
                   "the file name is too long or has a character that is not allowed");
  const bool is_parameter = ascii_iequals(bare.substr(0, 2), "QS") && bare.size() > 2 &&
                            std::all_of(bare.begin() + 2, bare.end(), is_digit);
  if (is_parameter) return parse_embedded_parameter(in, bare.data(), "");
  return parse_path_pieces(in, bare.data(), bare.data() + bare.size());
}

Label parse_label(BlockReader& in) {
  in.skip_blanks();
  if (in.at_number()) return in.digits(kLargestLabel, "the label");
  if (in.at_parameter()) return in.parameter();
  if (in.peek() != '"')
    return in.fail_expected("a label: a number, a name in double quotes or a parameter");
  const char* begin = in.at();
  const Text name = in.quoted_text(kLongestLabelName, "the name of the label");
  if (name.empty())
    in.fail(DiagnosticCode::LabelMalformed, in.since(begin), "the name of the label is empty");
  return name;
}

Expr parse_repeat(BlockReader& in) {
  const Expr repeat = parse_number(in);
  if (!in.accept('/')) return repeat;
  in.skip_blanks();
  if (in.at_parameter()) {
    in.parameter();
  } else {
    in.digits(kLargestLabel, "the count after '/'");
  }
  return repeat;
}

Statement parse_label_definition(BlockReader& in) {
  const char* begin = in.skip_blanks();
  const Label label = parse_label(in);
  if (std::holds_alternative<QRef>(label)) {
    in.fail(DiagnosticCode::LabelMalformed, in.since(begin),
            "a label is defined by a number or a name, not by a parameter");
  }
  return LabelDefinition{label};
}

Statement parse_call(BlockReader& in) {
  if (in.accept_prefix("LBL")) return read_form<LabelCall>(in);
  if (in.accept_word("PGM")) return read_form<CallProgram>(in);
  if (in.accept_word("SELECTED")) {
    if (in.accept_word("PGM")) return CallSelectedProgram{};
    return refuse_word(in, "CALL SELECTED");
  }
  return refuse_word(in, "CALL");
}

Statement parse_select(BlockReader& in) {
  if (in.accept_word("PGM")) return read_form<SelectProgram>(in);
  if (in.accept_word("TABLE")) return read_form<SelectTable>(in);
  return refuse_word(in, "SEL");
}

}  // namespace fitgauge::klartext

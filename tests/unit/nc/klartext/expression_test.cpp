#include <doctest/doctest.h>

#include "parse_support.hpp"

namespace fitgauge::klartext {
namespace {

/// The value of a formula of numbers alone, computed here from the tree.
double evaluate(const Program& program, const Expr& expr) {
  if (const auto* number = std::get_if<double>(&expr)) return *number;
  const auto index = std::get<NodeIndex>(expr);
  const auto operands = program.operands(index);
  const auto value = [&](std::size_t i) { return evaluate(program, operands[i]); };
  switch (program.node(index).op) {
    case Operator::Add: return value(0) + value(1);
    case Operator::Subtract: return value(0) - value(1);
    case Operator::Multiply: return value(0) * value(1);
    case Operator::Divide: return value(0) / value(1);
    case Operator::Modulo: return std::fmod(value(0), value(1));
    case Operator::Power: return std::pow(value(0), value(1));
    case Operator::Minus:
    case Operator::Neg: return -value(0);
    case Operator::Sq: return value(0) * value(0);
    case Operator::Sqrt: return std::sqrt(value(0));
    case Operator::Abs: return std::abs(value(0));
    case Operator::Int: return std::trunc(value(0));
    default: FAIL("the formula holds another operator"); return 0;
  }
}

double value_of(std::string_view formula) {
  const ParsedProgram parsed = parse_lines("Q1 = " + std::string(formula));
  CAPTURE(findings(parsed));
  REQUIRE(parsed.diagnostics.empty());
  return evaluate(parsed.program, statement_of<Assignment>(parsed).value);
}

TEST_CASE("Operators bind as on the control") {
  CHECK(value_of("2 ^ 3 ^ 2") == 512);
  CHECK(value_of("- 2 ^ 2") == 4);
  CHECK(value_of("-(2 ^ 2)") == -4);
  CHECK(value_of("0 - 2 ^ 2") == -4);
  CHECK(value_of("SQ 10 - 3^3") == 73);
  CHECK(value_of("SQ 3 ^ 2") == 81);
  CHECK(value_of("5 * 3 + 2 * 10") == 35);
  CHECK(value_of("400 % 360") == 40);
  CHECK(value_of("10 - 4 - 3") == 3);
  CHECK(value_of("100 / 5 / 2") == 10);
  CHECK(value_of("2 * - 3") == -6);
  CHECK(value_of("SQRT SQ - 3") == 3);
  CHECK(value_of("NEG ABS -5") == -5);
  CHECK(value_of("INT ( 1.5 + 0.99999999 )") == 2);
  CHECK(value_of("2 ^ - 1") == 0.5);
  CHECK(value_of("( ( 1 + 2 ) * ( 3 + 4 ) )") == 21);
}

TEST_CASE("Literals are the nearest doubles to what is written") {
  for (const std::string_view text :
       {"0.1", "25.013", "0.3333333333333333", "123456789.123456789", "999999999.999999",
        "0.000000000000000000001", "1,5", "10.", ".5", "000000000000012"}) {
    CAPTURE(text);
    std::string plain(text);
    std::replace(plain.begin(), plain.end(), ',', '.');
    CHECK(value_of(text) == std::strtod(plain.c_str(), nullptr));
  }
}

TEST_CASE("Formulas print with the parentheses they need and no others") {
  for (const std::string_view formula :
       {"Q1 = Q2 + Q3 * 4", "Q1 = ( Q2 + Q3 ) * 4", "Q1 = Q2 - ( Q3 - 4 )", "Q1 = Q2 - Q3 - 4",
        "Q1 = ( 2 ^ 3 ) ^ 2", "Q1 = 2 ^ 3 ^ 2", "Q1 = -2 ^ 2", "Q1 = -( 2 ^ 2 )", "Q1 = SIN 30 ^ 2",
        "Q1 = SIN ( 30 ^ 2 )", "Q1 = -Q5 * -3", "Q1 = SQRT ( QR4 ^ 2 + QR3 ^ 2 )", "QL1 = TAN QR5",
        "Q1 = SGN Q7 + PI", "Q1 = ATAN ( Q1 / Q2 ) % 360", "Q1 = -( -Q5 )"}) {
    CAPTURE(formula);
    CHECK(canonical(formula) == formula);
  }
}

TEST_CASE("Parentheses that change nothing are dropped") {
  CHECK(canonical("Q1 = SQRT ( ( QR4 ^ 2 ) + ( QR3 ^ 2 ) )") == "Q1 = SQRT ( QR4 ^ 2 + QR3 ^ 2 )");
}

TEST_CASE("A number and a text are not confused") {
  CHECK(first_finding("Q1 = QS2") == "2:6 parameter.type");
  CHECK(first_finding("QS1 = Q2") == "2:7 parameter.type");
  CHECK(first_finding("Q1 = 1 + \"2\"") == "2:10 parameter.type");
  CHECK(first_finding("Q1 = QS1 + 2") == "2:6 parameter.type");
  CHECK(first_finding("QS1 = QS2 || 5") == "2:14 parameter.type");
  CHECK(first_finding("QS1 = SIN QS2") == "2:11 parameter.type");
  CHECK(first_finding("FN 0: QS1 = +5").ends_with("parameter.type"));
  CHECK(first_finding("FN 11: IF QS1 GT QS2 GOTO LBL 1") == "2:11 parameter.type");
  CHECK(first_finding("FN 9: IF QS1 EQU +1 GOTO LBL 1") == "2:10 parameter.type");
  CHECK(first_finding("L X+QS1") == "2:4 parameter.type");
}

TEST_CASE("Deep formulas are refused, not followed") {
  const auto nested = [](std::size_t depth) {
    return "Q1 = " + std::string(depth, '(') + "1" + std::string(depth, ')');
  };
  CHECK(first_finding(nested(90)).empty());
  CHECK(first_finding(nested(200'000)) == "2:107 expression.too_deep");
  std::string functions = "Q1 = ";
  for (int i = 0; i < 1000; ++i) functions += "SIN ";
  CHECK(first_finding(functions + "1").ends_with("expression.too_deep"));
  std::string chain = "Q1 = 1";
  for (int i = 0; i < 100; ++i) chain += " + 1";
  CHECK(first_finding(chain).empty());
  for (int i = 0; i < 1000; ++i) chain += " + 1";
  CHECK(first_finding(chain).ends_with("expression.too_deep"));
}

}  // namespace
}  // namespace fitgauge::klartext

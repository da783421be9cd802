#include "nc/klartext/block_writer.hpp"
#include "nc/klartext/operator_names.hpp"

/// The formulas of BlockWriter.
namespace fitgauge::klartext {
namespace {

std::string_view binary_sign(Operator op) {
  switch (op) {
    case Operator::Concat: return " || ";
    case Operator::Add: return " + ";
    case Operator::Subtract: return " - ";
    case Operator::Multiply: return " * ";
    case Operator::Divide: return " / ";
    case Operator::Modulo: return " % ";
    default: return " ^ ";
  }
}

}  // namespace

BlockWriter::Level BlockWriter::level_of(const Expr& expr) const {
  if (const auto* literal = std::get_if<double>(&expr)) {
    return std::signbit(*literal) ? Level::Signed : Level::Alone;
  }
  const auto* index = std::get_if<NodeIndex>(&expr);
  if (index == nullptr) return Level::Alone;
  switch (program_.node(*index).op) {
    case Operator::Concat: return Level::Concat;
    case Operator::Add:
    case Operator::Subtract: return Level::Sum;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::Modulo: return Level::Product;
    case Operator::Power: return Level::Power;
    case Operator::Minus: return Level::Signed;
    default: return Level::Alone;
  }
}

void BlockWriter::expression(const Expr& expr, Level least) {
  const bool parentheses = level_of(expr) < least;
  if (parentheses) out_ += "( ";
  if (const auto* literal = std::get_if<double>(&expr)) {
    number(*literal);
  } else if (const auto* reference = std::get_if<QRef>(&expr)) {
    parameter(*reference);
  } else if (const auto* text = std::get_if<Text>(&expr)) {
    quoted(*text);
  } else if (const auto* index = std::get_if<NodeIndex>(&expr)) {
    node(*index);
  }
  if (parentheses) out_ += " )";
}

void BlockWriter::binary(const Expr& left, Level left_least, std::string_view sign,
                         const Expr& right, Level right_least) {
  expression(left, left_least);
  write(sign);
  expression(right, right_least);
}

void BlockWriter::node(NodeIndex index) {
  const Node& node = program_.node(index);
  const auto operands = program_.operands(index);
  const std::string_view sign = binary_sign(node.op);
  switch (node.op) {
    case Operator::Pi: write("PI"); return;
    case Operator::Concat:
      binary(operands[0], Level::Concat, sign, operands[1], Level::Sum);
      return;
    case Operator::Add:
    case Operator::Subtract:
      binary(operands[0], Level::Sum, sign, operands[1], Level::Product);
      return;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::Modulo:
      binary(operands[0], Level::Product, sign, operands[1], Level::Power);
      return;
    case Operator::Power:
      binary(operands[0], Level::Signed, sign, operands[1], Level::Power);
      return;
    case Operator::Minus:
      write("-");
      expression(operands[0], Level::Alone);
      return;
    default: break;
  }
  for (const FunctionName& function : kFunctions) {
    if (function.op != node.op) continue;
    write(function.name);
    write(" ");
    expression(operands[0], Level::Signed);
    return;
  }
  string_function(node);
}

void BlockWriter::string_function(const Node& node) {
  for (const StringFunction& function : kStringFunctions) {
    if (function.op != node.op) continue;
    const auto operands = program_.view(node.operands);
    write(function.name);
    write("(");
    for (std::size_t i = 0; i < function.argument_count; ++i) {
      if (is_absent(operands[i])) continue;
      write(" ");
      write(function.arguments[i].prefix);
      if (function.arguments[i].prefix == "DAT") {
        signed_value(operands[i]);
      } else {
        value(operands[i]);
      }
    }
    write(" )");
  }
}

}  // namespace fitgauge::klartext

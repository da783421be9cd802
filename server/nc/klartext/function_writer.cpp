#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/statement_writer.hpp"

/// Assignments and FN functions.
namespace fitgauge::klartext {
namespace {

const Expr& operand(const BlockWriter& out, const Expr& node, std::size_t i) {
  return out.program().operands(std::get<NodeIndex>(node))[i];
}

void write_fn_value(BlockWriter& out, const Assignment& assignment) {
  if (assignment.fn == 0) {
    out.signed_value(assignment.value);
    return;
  }
  const ArithmeticFn* function = find_arithmetic(assignment.fn);
  const bool unary = function->unary;
  if (!unary) {
    out.signed_value(operand(out, assignment.value, 0));
    out.write(" ");
  }
  out.write(function->sign).write(" ").signed_value(operand(out, assignment.value, unary ? 0 : 1));
}

}  // namespace

void write_fn(BlockWriter& out, unsigned fn) {
  out.write("FN ").write(std::to_string(fn)).write(":");
}

void write_address(BlockWriter& out, const Expr& address) {
  out.write("ID").value(operand(out, address, 0)).write(" NR").value(operand(out, address, 1));
  const Expr& index = operand(out, address, 2);
  if (is_absent(index)) return;
  out.write(" IDX").value(index);
}

void write_cell(BlockWriter& out, const Expr& cell) {
  out.value(operand(out, cell, 0));
  out.write("/").value(operand(out, cell, 1));
}

void write_block(BlockWriter& out, const Assignment& assignment) {
  constexpr unsigned kSystemRead = 18;
  const bool is_fn = assignment.form == AssignmentForm::Fn;
  if (is_fn) {
    write_fn(out, assignment.fn);
    out.write(assignment.fn == kSystemRead ? " SYSREAD " : " ");
  }
  if (assignment.form == AssignmentForm::DeclareString) out.write("DECLARE STRING ");
  out.parameter(assignment.target);
  out.write(" = ");
  if (!is_fn) {
    out.formula(assignment.value);
  } else if (assignment.fn == kSystemRead) {
    write_address(out, assignment.value);
  } else {
    write_fn_value(out, assignment);
  }
}

void write_block(BlockWriter& out, const SetUndefined& set) {
  out.write("FN 0: ").parameter(set.target).write(" SET UNDEFINED");
}

void write_block(BlockWriter& out, const ConditionalJump& jump) {
  constexpr unsigned kFirstComparison = 9;
  const Operator op = out.program().node(std::get<NodeIndex>(jump.condition)).op;
  unsigned fn = kFirstComparison;
  std::string_view name = op == Operator::IsDefined ? "IS DEFINED" : "IS UNDEFINED";
  for (const FunctionName& row : kComparisons) {
    if (row.op != op) continue;
    fn = kFirstComparison + static_cast<unsigned>(&row - kComparisons);
    name = row.name;
  }
  write_fn(out, fn);
  out.write(" IF ").signed_value(operand(out, jump.condition, 0)).write(" ").write(name);
  if (op != Operator::IsDefined && op != Operator::IsUndefined) {
    out.write(" ").signed_value(operand(out, jump.condition, 1));
  }
  out.write(" GOTO LBL ").label(jump.target);
}

}  // namespace fitgauge::klartext

#include "nc/program/lowering.hpp"

namespace fitgauge::interpreter {

using klartext::Node;

void CodeWriter::begin_block(std::uint32_t index) {
  block_ = index;
  used_temporaries_ = 0;
}

std::uint32_t CodeWriter::add(Instruction instruction) {
  instruction.blocks = std::exchange(pending_blocks_, 0);
  parts_.code.push_back(instruction);
  parts_.block_of.push_back(block_);
  return next() - 1;
}

void CodeWriter::flush() {
  if (pending_blocks_ != 0) add({.op = Op::Count});
}

std::uint32_t CodeWriter::constant(double value) {
  const auto [it, is_new] = constant_cells_.try_emplace(
      std::bit_cast<std::uint64_t>(value),
      kFirstConstant + static_cast<std::uint32_t>(parts_.constants.size()));
  if (is_new) parts_.constants.push_back(value);
  return it->second;
}

std::size_t CodeWriter::memory_bytes() const {
  // A constant is in two vectors that may have grown and in a node of the table that finds it.
  constexpr std::size_t kConstant = 2 * sizeof(double) + 6 * sizeof(void*);
  return parts_.code.size() * (sizeof(Instruction) + sizeof(std::uint32_t)) +
         parts_.constants.size() * kConstant;
}

std::uint32_t CodeWriter::temporary() {
  const std::uint32_t cell = kTemporaries + used_temporaries_++;
  parts_.temporaries = std::max(parts_.temporaries, used_temporaries_);
  return cell;
}

std::uint32_t CodeWriter::value(const Expr& expr) {
  if (const auto* number = std::get_if<double>(&expr)) return constant(*number);
  if (const auto* parameter = std::get_if<QRef>(&expr)) return cell_of(*parameter);
  const std::uint32_t cell = temporary();
  lower_node(cell, std::get<NodeIndex>(expr));
  return cell;
}

void CodeWriter::assign(std::uint32_t target, const Expr& expr) {
  if (const auto* node = std::get_if<NodeIndex>(&expr)) {
    lower_node(target, *node);
  } else {
    add({.op = Op::Copy, .a = value(expr), .c = target});
  }
}

void CodeWriter::lower_node(std::uint32_t target, NodeIndex index) {
  const Node& node = program_.node(index);
  if (!is_arithmetic(node.op)) {
    add({.op = Op::Evaluate, .a = index.value, .c = target});
    return;
  }
  const std::uint32_t used = used_temporaries_;
  const auto operands = program_.operands(index);
  Instruction instruction{.op = Op::Compute, .function = node.op, .c = target};
  if (!operands.empty()) instruction.a = value(operands[0]);
  // Without a second operand, any defined cell is usable.
  instruction.b = operands.size() > 1 ? value(operands[1]) : instruction.a;
  switch (node.op) {
    case Operator::Add: instruction.op = Op::Add; break;
    case Operator::Subtract: instruction.op = Op::Subtract; break;
    case Operator::Multiply: instruction.op = Op::Multiply; break;
    case Operator::Divide: instruction.op = Op::Divide; break;
    case Operator::Pi:
      instruction = {.op = Op::Copy, .a = constant(compute(Operator::Pi, 0, 0)), .c = target};
      break;
    default: break;
  }
  add(instruction);
  used_temporaries_ = used;  // the cells of the operands are free again
}

void CodeWriter::join_pairs() {
  for (std::size_t i = parts_.code.size(); i-- > 1;) {
    Instruction& first = parts_.code[i - 1];
    const Op second = parts_.code[i].op;
    if (first.op != Op::Add) continue;
    if (second == Op::JumpLess) first.op = Op::AddThenJumpLess;
    if (second == Op::AddThenJumpLess) first.op = Op::AddTwiceThenJumpLess;
    if (second == Op::Add) first.op = Op::AddThenAdd;
  }
}

void CodeWriter::place_temporaries() {
  const auto first_counter = kFirstConstant + static_cast<std::uint32_t>(parts_.constants.size());
  const auto move = [&](std::uint32_t& cell) {
    if (cell >= kTemporaries) {
      cell = cell - kTemporaries + first_counter + parts_.counters;
    } else if (cell >= kCounters) {
      cell = cell - kCounters + first_counter;
    }
  };
  for (Instruction& instruction : parts_.code) {
    move(instruction.a);
    move(instruction.b);
    move(instruction.c);
  }
}

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/klartext/expression.hpp"

/// The flat code that programs run as: three-address instructions over one array of doubles.
namespace fitgauge::interpreter {

/// Cells: first the parameters, then the cells of the running program.
inline constexpr std::uint32_t kFirstQ = 0;
inline constexpr std::uint32_t kFirstQr = kFirstQ + parameter_count(klartext::QSpace::Q);
inline constexpr std::uint32_t kFirstQl = kFirstQr + parameter_count(klartext::QSpace::Qr);
inline constexpr std::uint32_t kFirstConstant = kFirstQl + parameter_count(klartext::QSpace::Ql);

/// The cell of a numeric parameter. @pre not a QS.
constexpr std::uint32_t cell_of(klartext::QRef parameter) {
  switch (parameter.space) {
    case klartext::QSpace::Qr: return kFirstQr + parameter.number;
    case klartext::QSpace::Ql: return kFirstQl + parameter.number;
    default: return kFirstQ + parameter.number;
  }
}

/// The parameter of a cell. @pre cell < kFirstConstant
constexpr klartext::QRef parameter_of(std::uint32_t cell) {
  if (cell >= kFirstQl) return {klartext::QSpace::Ql, static_cast<std::uint16_t>(cell - kFirstQl)};
  if (cell >= kFirstQr) return {klartext::QSpace::Qr, static_cast<std::uint16_t>(cell - kFirstQr)};
  return {klartext::QSpace::Q, static_cast<std::uint16_t>(cell)};
}

/// Operations of an instruction on its operands `a`, `b` and its result or target `c`.
enum class Op : std::uint8_t {
  // c = a op b, all cells
  Add,
  Subtract,
  Multiply,
  Divide,
  Copy,      ///< c = a
  Compute,   ///< c = function(a, b), any other operator
  Evaluate,  ///< c = the expression node of index a: strings, system data
  // on to instruction c, comparing cells
  JumpEqual,
  JumpNotEqual,
  JumpGreater,
  JumpLess,
  JumpDefined,    ///< cell a
  JumpUndefined,  ///< cell a
  JumpWhen,       ///< the condition node of index a (strings)
  // additions in one step with the next instruction, which stays for jumps to it
  AddThenAdd,
  AddThenJumpLess,       ///< the end of a counted loop
  AddTwiceThenJumpLess,  ///< Add, then AddThenJumpLess
  // flow
  Count,      ///< nothing: accounts for blocks without effect before a label
  SkipBlock,  ///< on to c while the operator's block skip is on
  CallLabel,  ///< subprogram at c
  LabelEnd,   ///< LBL 0: back to the caller, if there is one
  Repeat,     ///< CALL LBL REP: continue at c; a is the cell of the count, b of the counter
  Statement,  ///< all others: block a; in a dotted cycle b is the block of its first part
  End,        ///< the end of the program
};

struct Instruction {
  Op op = Op::End;
  klartext::Operator function{};  ///< of Compute
  std::uint32_t blocks = 0;       ///< that this instruction begins, for the budget
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
};

}  // namespace fitgauge::interpreter

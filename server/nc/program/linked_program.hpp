#pragma once

#include <unordered_map>

#include "nc/program/control_disk.hpp"
#include "nc/program/cycles.hpp"

namespace fitgauge::interpreter {

// The flat code that programs run as: three-address instructions over one array of doubles.

/// Cells: first the parameters, then the cells of the running program.
inline constexpr std::uint32_t kFirstQ = 0;
inline constexpr std::uint32_t kFirstQr = kFirstQ + parameter_count(QSpace::Q);
inline constexpr std::uint32_t kFirstQl = kFirstQr + parameter_count(QSpace::Qr);
inline constexpr std::uint32_t kFirstConstant = kFirstQl + parameter_count(QSpace::Ql);

/// The cell of a numeric parameter. @pre not a QS.
constexpr std::uint32_t cell_of(QRef parameter) {
  switch (parameter.space) {
    case QSpace::Qr: return kFirstQr + parameter.number;
    case QSpace::Ql: return kFirstQl + parameter.number;
    default: return kFirstQ + parameter.number;
  }
}

/// The parameter of a cell. @pre cell < kFirstConstant
constexpr QRef parameter_of(std::uint32_t cell) {
  if (cell >= kFirstQl) return {QSpace::Ql, static_cast<std::uint16_t>(cell - kFirstQl)};
  if (cell >= kFirstQr) return {QSpace::Qr, static_cast<std::uint16_t>(cell - kFirstQr)};
  return {QSpace::Q, static_cast<std::uint16_t>(cell)};
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
  Operator function{};       ///< of Compute
  std::uint32_t blocks = 0;  ///< that this instruction begins, for the budget
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
};

/// The extension of a program that `caller` names without one: `CALL PGM 82551`, `%82551`.
inline std::string_view program_extension(const ControlPath& caller) {
  return caller.key().ends_with(".i") ? ".I" : ".H";
}

/// Pools that the linker fills and a LinkedProgram freezes.
struct LinkedParts {
  std::vector<Instruction> code;        ///< ends with Op::End
  std::vector<std::uint32_t> block_of;  ///< for each instruction the index of its block
  std::vector<double> constants;        ///< cells from kFirstConstant on
  std::vector<BoundCycle> cycles;       ///< of the blocks of cycles in Q parameters, in their order
  std::uint32_t counters = 0;           ///< cells for the REP of label calls, after constants
  std::uint32_t temporaries = 0;        ///< cells after the counters
  struct LabelPlace {
    std::uint32_t instruction;  ///< after it
    std::uint32_t block;
  };
  /// By the number, or by the name in capitals and quotes: `5`, `"END"`.
  std::unordered_map<std::string, LabelPlace> labels;

  /// The instruction after a label as it is written (`5`, `"End"`), or nothing.
  std::optional<std::uint32_t> label(std::string_view written) const;
};

/// A program with labels, cycles and jumps resolved and its formulas lowered to flat code.
/// Immutable, so that any number of runs and threads may share it.
class LinkedProgram {
 public:
  LinkedProgram(ControlPath path, Program program, LinkedParts parts)
      : path_(std::move(path)), program_(std::move(program)), parts_(std::move(parts)) {}
  LinkedProgram& operator=(LinkedProgram&&) = delete;  // neither copied nor moved

  const ControlPath& path() const { return path_; }
  const Program& program() const { return program_; }
  bool is_inch() const { return program_.unit() == klartext::Unit::Inch; }

  const std::vector<Instruction>& code() const { return parts_.code; }
  const std::vector<double>& constants() const { return parts_.constants; }
  std::uint32_t counters() const { return parts_.counters; }
  const BoundCycle& cycle(std::uint32_t index) const { return parts_.cycles[index]; }

  /// All cells for a run of this program, with those of other programs.
  std::size_t cells() const {
    return kFirstConstant + parts_.constants.size() + parts_.counters + parts_.temporaries;
  }
  std::uint32_t block_of(std::size_t instruction) const { return parts_.block_of[instruction]; }

  /// First instruction of a block, by its number as written or counted, or of the next one; none if
  /// no block has the number.
  std::optional<std::uint32_t> instruction_of(std::uint32_t block_number) const;

  /// As LinkedParts::label.
  std::optional<std::uint32_t> label(std::string_view written) const {
    return parts_.label(written);
  }

 private:
  ControlPath path_;
  Program program_;
  LinkedParts parts_;
};

}  // namespace fitgauge::interpreter

#pragma once

#include <unordered_map>

#include "nc/program/linked_program.hpp"

namespace fitgauge::interpreter {

/// Writes the flat code of a program: one instruction after another, formulas as three-address
/// code. Knows nothing of labels; jump targets are filled in by the linker. `parts` get the code,
/// its blocks, the constants and the number of temporaries.
class CodeWriter {
 public:
  CodeWriter(const Program& program, LinkedParts& parts) : program_(program), parts_(parts) {
    // Usually one instruction a block; unused reserved memory is never touched.
    parts.code.reserve(program.blocks().size());
    parts.block_of.reserve(program.blocks().size());
  }

  /// The following code belongs to that block.
  void begin_block(std::uint32_t index);
  /// The block is passed over in the flow and only counted.
  void count_block() { ++pending_blocks_; }
  /// Accounts for blocks counted so far before a place that can be jumped to.
  void flush();

  /// Adds an instruction and returns its index.
  std::uint32_t add(Instruction instruction);
  std::uint32_t next() const { return static_cast<std::uint32_t>(parts_.code.size()); }
  Instruction& at(std::uint32_t index) { return parts_.code[index]; }

  /// The cell with the value of a numeric expression, after the code that computes it.
  std::uint32_t value(const Expr& expr);
  /// Computes a numeric expression into a cell.
  void assign(std::uint32_t target, const Expr& expr);
  std::uint32_t constant(double value);

  /// The most memory of the code while it is written.
  std::size_t memory_bytes() const;

  /// Joins two instructions that often follow each other, once no more are added.
  void join_pairs();
  /// Moves the temporaries after the counters, because their number is known only at the end.
  void place_temporaries();

  /// A cell of the counters, which follow the constants; both get their place at the end.
  static constexpr std::uint32_t counter(std::uint32_t index) { return kCounters + index; }

 private:
  // Provisional numbers of counters and temporaries, until the number of constants is known. A
  // program has fewer than 2^22 blocks, and an expression fewer nodes than that.
  static constexpr std::uint32_t kCounters = 1U << 30;
  static constexpr std::uint32_t kTemporaries = 1U << 31;

  std::uint32_t temporary();
  void lower_node(std::uint32_t target, NodeIndex index);

  const Program& program_;
  LinkedParts& parts_;
  std::unordered_map<std::uint64_t, std::uint32_t> constant_cells_;  // by bit pattern
  std::uint32_t block_ = 0;
  std::uint32_t pending_blocks_ = 0;
  std::uint32_t used_temporaries_ = 0;
};

}  // namespace fitgauge::interpreter

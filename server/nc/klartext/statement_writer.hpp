#pragma once

#include "nc/klartext/block_writer.hpp"

/// Each writes one kind of statement; plain forms are in forms.hpp.
namespace fitgauge::klartext {

// statement_writer.cpp
void write_block(BlockWriter& out, const Empty& empty);
void write_block(BlockWriter& out, const BeginProgram& begin);
void write_block(BlockWriter& out, const EndProgram& end);
void write_block(BlockWriter& out, const Structure& structure);
void write_block(BlockWriter& out, const ErrorBlock& error);
void write_block(BlockWriter& out, const Unsupported& unsupported);
void write_block(BlockWriter& out, const BlankForm& form);
void write_block(BlockWriter& out, const ToolCall& call);
void write_block(BlockWriter& out, const ToolDefinition& definition);
void write_block(BlockWriter& out, const Motion& motion);
void write_block(BlockWriter& out, const MFunctions& functions);
void write_block(BlockWriter& out, const Trans& trans);
void write_block(BlockWriter& out, const Plane& plane);
void write_block(BlockWriter& out, const FunctionMode& mode);
void write_block(BlockWriter& out, const FunctionTcpm& tcpm);
void write_block(BlockWriter& out, const PatternDefinition& pattern);

// cycle_writer.cpp
void write_block(BlockWriter& out, const Cycle& cycle);
void write_block(BlockWriter& out, const CyclePart& part);
void write_block(BlockWriter& out, const CycleCall& call);
/// Writes a cycle; the comment of its first line is before the parameters.
void write_cycle(BlockWriter& out, const Cycle& cycle, std::string_view first_comment);

// function_writer.cpp
/// `FN 14:`
void write_fn(BlockWriter& out, unsigned fn);
/// `ID50 NR4 IDXQ2`, of FN 17 and 18.
void write_address(BlockWriter& out, const Expr& address);
/// `5/"Radius,Depth"`, of FN 27 and 28.
void write_cell(BlockWriter& out, const Expr& cell);
void write_block(BlockWriter& out, const Assignment& assignment);
void write_block(BlockWriter& out, const SetUndefined& set);
void write_block(BlockWriter& out, const ConditionalJump& jump);

}  // namespace fitgauge::klartext

#pragma once

#include <string_view>

#include "nc/klartext/block_writer.hpp"

/// Writes one kind of statement each.
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
void write_block(BlockWriter& out, const Stop& stop);
void write_block(BlockWriter& out, const LabelDefinition& definition);
void write_block(BlockWriter& out, const LabelCall& call);
void write_block(BlockWriter& out, const CallProgram& call);
void write_block(BlockWriter& out, const SelectProgram& select);
void write_block(BlockWriter& out, const CallSelectedProgram& call);
void write_block(BlockWriter& out, const SelectTable& select);
void write_block(BlockWriter& out, const Trans& trans);
void write_block(BlockWriter& out, const Plane& plane);
void write_block(BlockWriter& out, const FunctionMode& mode);
void write_block(BlockWriter& out, const FunctionTcpm& tcpm);
void write_block(BlockWriter& out, const PatternDefinition& pattern);
void write_block(BlockWriter& out, const Dwell& dwell);

// cycle_writer.cpp
void write_block(BlockWriter& out, const Cycle& cycle);
void write_block(BlockWriter& out, const CyclePart& part);
void write_block(BlockWriter& out, const CycleCall& call);
/// With the comment of its first line, which ends before the parameters.
void write_cycle(BlockWriter& out, const Cycle& cycle, std::string_view first_comment);

// function_writer.cpp
void write_block(BlockWriter& out, const Assignment& assignment);
void write_block(BlockWriter& out, const SetUndefined& set);
void write_block(BlockWriter& out, const ConditionalJump& jump);
void write_block(BlockWriter& out, const ErrorStop& stop);
void write_block(BlockWriter& out, const Print& print);
void write_block(BlockWriter& out, const FormattedPrint& print);
void write_block(BlockWriter& out, const SystemWrite& write);
void write_block(BlockWriter& out, const CircleData& circle);
void write_block(BlockWriter& out, const ExternalFunction& function);
void write_block(BlockWriter& out, const WaitFor& wait);
void write_block(BlockWriter& out, const TableOpen& open);
void write_block(BlockWriter& out, const TableWrite& write);
void write_block(BlockWriter& out, const TableRead& read);

}  // namespace fitgauge::klartext

#pragma once

#include "nc/klartext/block_reader.hpp"

/// The grammar: one function for each family of blocks, which begins after the block's first
/// keyword and reads to the end of its code. After a failure their results are dropped.
namespace fitgauge::klartext {

// parser_expression.cpp
/// A formula of numbers or texts: everything right of `Q5 =`.
Expr parse_formula(BlockReader& in);
/// A number with an optional sign, or any parameter: `+10`, `-Q5`, `QS1`.
Expr parse_value(BlockReader& in);
/// Parses a value without QS parameters.
Expr parse_number(BlockReader& in);
/// A quoted text or a QS parameter.
Expr parse_string(BlockReader& in);

/// Reads a function of texts with its arguments; false if no name of one is next.
bool parse_string_function(BlockReader& in, Expr& value);

// parser_flow.cpp
/// A file: quoted, bare up to `stop` or the end, a QS parameter (`QS1`, `:'QS1'`), or bare with
/// QS parameters inside (`TNC:\:'QS1'.H`).
Expr parse_path(BlockReader& in, char stop = ';');
Label parse_label(BlockReader& in);
/// `REP 2`, `REPQ106`, and the older listings' `REP 2/2`, `REP Q3/Q3`: the value after the slash is
/// the control's count of remaining repetitions. Starts after REP.
Expr parse_repeat(BlockReader& in);
Statement parse_label_definition(BlockReader& in);
Statement parse_call(BlockReader& in);
Statement parse_select(BlockReader& in);

// parser_frame.cpp
Statement parse_begin(BlockReader& in);
Statement parse_end(BlockReader& in);
Statement parse_blank_form(BlockReader& in);
Statement parse_structure(BlockReader& in);

// parser_function.cpp
Statement parse_assignment(BlockReader& in);
Statement parse_declare(BlockReader& in);
Statement parse_fn(BlockReader& in);
/// The parameter of a number that receives a result.
QRef parse_target(BlockReader& in);
/// Values separated by `/`, texts in double quotes among them.
Slice<Expr> parse_items(BlockReader& in);
/// `ID50 NR4 IDXQ2`.
Expr parse_system_address(BlockReader& in, Operator op);
/// `5/"Radius,Depth"`.
Expr parse_cell(BlockReader& in);

// parser_cycle.cpp
Statement parse_cycl(BlockReader& in);
Statement parse_tch_probe(BlockReader& in);
Statement parse_global(BlockReader& in);
/// `Q200 =`, `QS400 =`: a parameter of a cycle starts here.
bool at_cycle_parameter(const char* at, const char* end);
// parser_dotted_cycle.cpp
/// `.0` after the number of a cycle, perhaps after blanks (`DEF 9 .0`). Does not advance.
bool at_cycle_part(BlockReader& in);
Statement parse_cycle_part(BlockReader& in, CycleFamily family, std::uint16_t number);

// parser_motion.cpp
Statement parse_motion(BlockReader& in, Path path);
Statement parse_approach(BlockReader& in);
Statement parse_departure(BlockReader& in);
Statement parse_m_functions(BlockReader& in);
Statement parse_pattern(BlockReader& in);
Statement parse_tool(BlockReader& in);

// parser_transformation.cpp
Statement parse_trans(BlockReader& in);
Statement parse_plane(BlockReader& in);
Statement parse_function(BlockReader& in);

// parser_block.cpp
/// Fails: the block has none of the words that `what` names.
Statement expected(BlockReader& in, std::string_view what);
/// Refuses `first` and the next word, a feature that only real controls have.
Statement refuse_word(BlockReader& in, std::string_view first);
/// The statement of a block that is not empty.
Statement parse_statement(BlockReader& in);

}  // namespace fitgauge::klartext

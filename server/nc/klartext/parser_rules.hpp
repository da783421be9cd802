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

// parser_function.cpp
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
/// `.0` after the number of a cycle, perhaps after blanks (`DEF 9 .0`). Does not advance.
bool at_cycle_part(BlockReader& in);

// parser_motion.cpp
Statement parse_motion(BlockReader& in, Path path);
Statement parse_approach(BlockReader& in);
Statement parse_departure(BlockReader& in);
Statement parse_m_functions(BlockReader& in);
Statement parse_pattern(BlockReader& in);
Statement parse_tool(BlockReader& in);
/// `5`, `5.1`, `Q5`, `"NAME"`, `QS1`; Absent when none of them is next.
Expr parse_tool_name(BlockReader& in);
/// Reads an axis that is one letter alone: of `Z`, of `X-`; none of `XY`.
std::optional<Axis> parse_axis_alone(BlockReader& in);

// parser_transformation.cpp
Statement parse_trans(BlockReader& in);
Statement parse_plane(BlockReader& in);
Statement parse_function(BlockReader& in);

// parser_block.cpp
/// `name MM`: the unit is the last word, the name may hold blanks.
void parse_frame(BlockReader& in, Text& name, Unit& unit);
/// Refuses `first` and the next word, a feature that only real controls have.
Statement refuse_word(BlockReader& in, std::string_view first);
/// The statement of a block that is not empty.
Statement parse_statement(BlockReader& in);

// The plain forms of Klartext, each described once: the parser reads a statement along its form()
// and the printer writes it along the same one. `io` is a FormReader or a FormWriter.

/// Reads the members of a form, after its first words.
class FormReader {
 public:
  explicit FormReader(BlockReader& in) : in_(in) {}

  /// The first words, which identify the form.
  FormReader& head(std::string_view) { return *this; }
  FormReader& fn(unsigned) { return *this; }
  FormReader& word(std::string_view word) { return in_.expect_word(word), *this; }
  FormReader& mark(char c) { return in_.expect(c), *this; }
  /// A mark that may be left out.
  FormReader& maybe(char c) { return in_.accept(c), *this; }
  /// Reads like maybe(); the writer joins it to the next text.
  FormReader& joined(char c) { return maybe(c); }
  /// One of two words, joined to what follows.
  FormReader& either(bool& is_first, std::string_view first, std::string_view second) {
    is_first = in_.accept_prefix(first);
    if (!is_first) in_.expect_prefix(second);
    return *this;
  }
  FormReader& number(Expr& value) { return value = parse_number(in_), *this; }
  /// Reads like number(); the writer prints its sign.
  FormReader& signed_number(Expr& value) { return number(value); }
  /// A path that ends before `stop`.
  FormReader& path(Expr& path, char stop = ';') { return path = parse_path(in_, stop), *this; }
  FormReader& parameter(QRef& parameter) { return parameter = in_.parameter(), *this; }
  /// The parameter of a number.
  FormReader& target(QRef& target) { return target = parse_target(in_), *this; }
  FormReader& items(Slice<Expr>& items) { return items = parse_items(in_), *this; }
  FormReader& cell(Expr& cell) { return cell = parse_cell(in_), *this; }
  FormReader& address(Expr& address) {
    return address = parse_system_address(in_, Operator::SystemAddress), *this;
  }
  FormReader& label(Label& label) { return label = parse_label(in_), *this; }
  FormReader& repeat(Expr& count) {
    if (in_.accept_prefix("REP")) count = parse_repeat(in_);
    return *this;
  }
  FormReader& words(Slice<Word>& words, LetterSet allowed) {
    return words = parse_words(in_, allowed), *this;
  }
  FormReader& frame(Text& name, Unit& unit) { return parse_frame(in_, name, unit), *this; }
  FormReader& tool(Expr& tool, bool is_required) {
    tool = parse_tool_name(in_);
    if (is_required && is_absent(tool)) in_.fail_expected("the number or name of a tool");
    return *this;
  }
  FormReader& axis(std::optional<Axis>& axis) { return axis = parse_axis_alone(in_), *this; }
  /// All up to the end of the block.
  FormReader& rest(Text& text) { return text = in_.add_text(free_text(in_.rest())), *this; }

 private:
  BlockReader& in_;
};

void form(auto& io, BeginProgram& begin) { io.head("BEGIN PGM").frame(begin.name, begin.unit); }
void form(auto& io, EndProgram& end) { io.head("END PGM").frame(end.name, end.unit); }
void form(auto& io, ToolCall& call) {
  constexpr LetterSet kWords = kFeeds | LetterSet(Letter::S, Letter::Dl, Letter::Dr, Letter::Dr2);
  io.head("TOOL CALL").tool(call.tool, false).axis(call.axis).words(call.words, kWords);
}
void form(auto& io, ToolDefinition& definition) {
  io.head("TOOL DEF").tool(definition.tool, true);
  io.words(definition.words, LetterSet(Letter::L, Letter::R));
}
void form(auto& io, Stop& stop) { io.head("STOP").words(stop.words, LetterSet(Letter::M)); }
void form(auto& io, LabelDefinition& definition) { io.head("LBL").label(definition.label); }
void form(auto& io, LabelCall& call) { io.head("CALL LBL").label(call.label).repeat(call.repeat); }
void form(auto& io, CallProgram& call) { io.head("CALL PGM").path(call.path); }
void form(auto& io, CallSelectedProgram&) { io.head("CALL SELECTED PGM"); }
void form(auto& io, SelectProgram& select) { io.head("SEL PGM").path(select.path); }
void form(auto& io, SelectTable& select) { io.head("SEL TABLE").path(select.path); }
void form(auto& io, Dwell& dwell) {
  io.head("FUNCTION DWELL").either(dwell.revolutions, "REV", "TIME").number(dwell.value);
}
void form(auto& io, ErrorStop& stop) { io.fn(14).word("ERROR").maybe('=').number(stop.number); }
void form(auto& io, Print& print) { io.fn(15).word("PRINT").items(print.items); }
void form(auto& io, FormattedPrint& print) {
  io.fn(16).word("F-PRINT").path(print.mask, '/').mark('/').path(print.target);
}
void form(auto& io, SystemWrite& write) {
  io.fn(17).word("SYSWRITE").address(write.address).mark('=').signed_number(write.value);
}
/// FN 19, 29, 37 and 38; the parser sets the number.
void form(auto& io, ExternalFunction& function) {
  io.fn(function.fn);
  switch (function.fn) {
    case 37: io.word("EXPORT"); break;
    case 38: io.word("SEND").joined('/'); break;
    default: io.word("PLC").mark('=');
  }
  io.items(function.operands);
}
void form(auto& io, WaitFor& wait) { io.fn(20).word("WAIT").word("FOR").rest(wait.condition); }
/// FN 23 and 24; the parser sets how many points.
void form(auto& io, CircleData& circle) {
  io.fn(20U + circle.points).target(circle.target).mark('=').word("CDATA");
  io.target(circle.first_point);
}
void form(auto& io, TableOpen& open) { io.fn(26).word("TABOPEN").path(open.path); }
void form(auto& io, TableWrite& write) {
  io.fn(27).word("TABWRITE").cell(write.cell).mark('=').parameter(write.first);
}
void form(auto& io, TableRead& read) {
  io.fn(28).word("TABREAD").parameter(read.first).mark('=').cell(read.cell);
}

template <class S>
Statement read_form(BlockReader& in, S statement = {}) {
  FormReader io(in);
  form(io, statement);
  return statement;
}

}  // namespace fitgauge::klartext

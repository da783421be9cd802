#include "nc/klartext/parser.hpp"

#include "nc/klartext/block_writer.hpp"
#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

const Expr& operand(const BlockWriter& out, const Expr& node, std::size_t i) {
  return out.program().operands(std::get<NodeIndex>(node))[i];
}

/// `FN 14:`
void write_fn(BlockWriter& out, unsigned fn) {
  out.write("FN ").write(std::to_string(fn)).write(":");
}

/// `ID50 NR4 IDXQ2`, of FN 17 and 18.
void write_address(BlockWriter& out, const Expr& address) {
  out.write("ID").value(operand(out, address, 0)).write(" NR").value(operand(out, address, 1));
  const Expr& index = operand(out, address, 2);
  if (!is_absent(index)) out.write(" IDX").value(index);
}

/// `5/"Radius,Depth"`, of FN 27 and 28.
void write_cell(BlockWriter& out, const Expr& cell) {
  out.value(operand(out, cell, 0)).write("/").value(operand(out, cell, 1));
}

std::string_view name_of(Axis axis) { return spelling(letter_of(axis)); }

/// Writes the members of a form, each after a blank.
class FormWriter {
 public:
  explicit FormWriter(BlockWriter& out) : out_(out) {}

  FormWriter& head(std::string_view words) { return out_.write(words), *this; }
  FormWriter& fn(unsigned number) { return write_fn(out_, number), *this; }
  FormWriter& word(std::string_view word) { return blank().write(word), *this; }
  FormWriter& mark(char c) { return word({&c, 1}); }
  FormWriter& maybe(char c) { return mark(c); }
  FormWriter& joined(char c) { return mark(c).join(); }
  FormWriter& either(bool is_first, std::string_view first, std::string_view second) {
    return word(is_first ? first : second).join();
  }
  FormWriter& number(const Expr& value) { return blank().value(value), *this; }
  FormWriter& signed_number(const Expr& value) { return blank().signed_value(value), *this; }
  FormWriter& path(const Expr& path, char = ';') { return blank().path(path), *this; }
  FormWriter& parameter(QRef parameter) { return blank().parameter(parameter), *this; }
  FormWriter& target(QRef target) { return parameter(target); }
  FormWriter& items(Slice<Expr> items) { return blank().items(items), *this; }
  FormWriter& cell(const Expr& cell) { return write_cell(blank(), cell), *this; }
  FormWriter& address(const Expr& address) { return write_address(blank(), address), *this; }
  FormWriter& label(const Label& label) { return blank().label(label), *this; }
  FormWriter& repeat(const Expr& count) {
    return is_absent(count) ? *this : word("REP").join().number(count);
  }
  FormWriter& words(Slice<Word> words, LetterSet) { return out_.words(words), *this; }
  FormWriter& frame(Text name, Unit unit) {
    if (!name.empty()) blank().write(name);
    return word(unit == Unit::Inch ? "INCH" : "MM");
  }
  FormWriter& tool(const Expr& tool, bool) { return is_absent(tool) ? *this : number(tool); }
  FormWriter& axis(std::optional<Axis> axis) { return axis ? word(name_of(*axis)) : *this; }
  FormWriter& rest(Text text) { return blank().write(text), *this; }

 private:
  FormWriter& join() { return joined_ = true, *this; }
  BlockWriter& blank() {
    if (!std::exchange(joined_, false)) out_.write(" ");
    return out_;
  }

  BlockWriter& out_;
  bool joined_ = false;
};

template <class S>
requires requires(FormWriter& io, S& statement) { form(io, statement); }
void write_block(BlockWriter& out, S statement) {
  FormWriter io(out);
  form(io, statement);
}

/// Feeds and M functions end a positioning block; the compensation stands before them.
constexpr LetterSet kFeedsAndM = kFeeds | LetterSet(Letter::M);

void write_block(BlockWriter&, const Empty&) {}

void write_block(BlockWriter& out, const Structure& structure) {
  out.write("*").write(std::string(1 + 2 * std::size_t{structure.level}, ' ')).write("- ");
  out.write(structure.text);
}

void write_block(BlockWriter& out, const ErrorBlock& error) {
  out.write("ERROR = ").write(error.text);
}

void write_block(BlockWriter& out, const Unsupported& unsupported) { out.write(unsupported.text); }

void write_block(BlockWriter& out, const BlankForm& form) {
  out.write("BLK FORM ").write(word_of(form.kind, kBlankKinds));
  if (form.tool_axis) out.write(" ").write(name_of(*form.tool_axis));
  if (!is_absent(form.file)) out.write(" ").value(form.file);
  out.words(form.words);
}

void write_block(BlockWriter& out, const Motion& motion) {
  out.write(word_of(motion.path, kPaths));
  const std::string marks =
      fmt::format("{}{}", word_of(motion.rotation, {"", " DR+", " DR-"}),
                  word_of(motion.compensation, {"", " R0", " RL", " RR", " R+", " R-"}));
  out.words(motion.words, marks, kFeedsAndM);
}

void write_block(BlockWriter& out, const MFunctions& functions) { out.words(functions.words); }

void write_block(BlockWriter& out, const Trans& trans) {
  out.write("TRANS ");
  out.write(word_of(trans.kind, {"DATUM", "DATUM TABLE", "MIRROR", "ROTATION", "SCALE"}));
  const bool axes = trans.kind == Transformation::Datum || trans.kind == Transformation::Mirror;
  out.write(trans.reset ? " RESET" : axes ? " AXIS" : "");
  if (!is_absent(trans.table)) out.write(" ").value(trans.table);
  out.words(trans.words);
}

void write_block(BlockWriter& out, const Plane& plane) {
  constexpr LetterSet kBehind =
      kFeedsAndM | LetterSet(Letter::Mb, Letter::MbMax, Letter::Dist, Letter::Seq, Letter::Sym,
                             Letter::TableRot, Letter::CoordRot);
  out.write("PLANE ").write(word_of(plane.kind, kPlaneKinds));
  const std::string_view how = word_of(plane.positioning, kPlanePositionings);
  out.words(plane.words, fmt::format("{}{}", how.empty() ? "" : " ", how), kBehind);
}

void write_block(BlockWriter& out, const PatternDefinition& pattern) {
  out.write("PATTERN DEF");
  std::string_view end;
  const auto words = out.program().view(pattern.words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].letter != Letter::Element) {
      out.write(" ").word(words[i]);
      continue;
    }
    out.write(end).write(" ~\n    ");
    out.write(kPatternElements[static_cast<std::size_t>(std::get<double>(words[i].value))]);
    out.value(words[++i].value);  // its number
    out.write("(");
    end = " )";
  }
  out.write(end);
}

void write_block(BlockWriter& out, const FunctionMode& mode) {
  out.write("FUNCTION MODE MILL");
  if (!mode.kinematics.empty()) out.write(" ").quoted(mode.kinematics);
}

void write_block(BlockWriter& out, const FunctionTcpm& tcpm) {
  out.write(tcpm.active ? "FUNCTION TCPM " : "FUNCTION RESET TCPM").write(tcpm.options);
}

void write_head(BlockWriter& out, CycleFamily family, unsigned number) {
  out.write(words_of(family)).write(" ").write(std::to_string(number));
}

void write_value(BlockWriter& out, const CycleParameter& parameter) {
  switch (parameter.kind) {
    case CycleValue::Auto: out.write("AUTO"); return;
    case CycleValue::Max: out.write("MAX"); return;
    case CycleValue::Predef: out.write("PREDEF"); return;
    case CycleValue::Fu: out.write("FU"); break;
    case CycleValue::Fz: out.write("FZ"); break;
    case CycleValue::Expression: break;
  }
  out.signed_value(parameter.value);
}

/// The comment of its first line is before the parameters.
void write_block(BlockWriter& out, const Cycle& cycle, std::string_view first_comment) {
  write_head(out, cycle.family, cycle.number);
  if (!cycle.dialog.empty()) out.write(" ").write(cycle.dialog);
  const auto write_comment = [&](std::string_view comment) {
    if (!comment.empty()) out.write(" ;").write(comment);
  };
  write_comment(first_comment);
  for (const CycleParameter& parameter : out.program().view(cycle.parameters)) {
    out.write(" ~\n    ").parameter(parameter.parameter).write("=");
    write_value(out, parameter);
    write_comment(out.program().text(parameter.comment));
  }
}

void write_block(BlockWriter& out, const CyclePart& part) {
  write_head(out, part.family, part.number);
  out.write(".").write(std::to_string(part.part));
  if (!part.text.empty()) out.write(" ").write(part.text);
}

void write_block(BlockWriter& out, const CycleCall& call) {
  out.write("CYCL CALL").write(word_of(call.kind, {"", " PAT", " POS"})).words(call.words);
}

void write_fn_value(BlockWriter& out, const Assignment& assignment) {
  if (assignment.fn == 0) {
    out.signed_value(assignment.value);
    return;
  }
  const ArithmeticFn* function = find_arithmetic(assignment.fn);
  const bool unary = function->unary;
  if (!unary) out.signed_value(operand(out, assignment.value, 0)).write(" ");
  out.write(function->sign).write(" ").signed_value(operand(out, assignment.value, unary ? 0 : 1));
}

void write_block(BlockWriter& out, const Assignment& assignment) {
  constexpr unsigned kSystemRead = 18;
  const bool is_fn = assignment.form == AssignmentForm::Fn;
  if (is_fn) {
    write_fn(out, assignment.fn);
    out.write(assignment.fn == kSystemRead ? " SYSREAD " : " ");
  }
  if (assignment.form == AssignmentForm::DeclareString) out.write("DECLARE STRING ");
  out.parameter(assignment.target).write(" = ");
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
  const Operator op = out.program().node(std::get<NodeIndex>(jump.condition)).op;
  const std::size_t comparison = place_of(op, Operator::Equal);
  const bool compares = comparison < std::size(kComparisons);
  write_fn(out, kFirstComparison + static_cast<unsigned>(compares ? comparison : 0));
  out.write(" IF ").signed_value(operand(out, jump.condition, 0)).write(" ");
  if (compares) {
    out.write(kComparisons[comparison]).write(" ").signed_value(operand(out, jump.condition, 1));
  } else {
    out.write(op == Operator::IsDefined ? "IS DEFINED" : "IS UNDEFINED");
  }
  out.write(" GOTO LBL ").label(jump.target);
}

void print_block(BlockWriter& out, const Program& program, const Block& block,
                 std::optional<std::uint32_t> number) {
  std::string_view separator;
  if (block.skip) out.write("/");
  if (number) {
    out.write(std::to_string(*number));
    separator = " ";
  }
  const std::string_view comment = program.text(block.comment);
  const auto write = [&](const auto& statement) {
    if constexpr (requires { write_block(out, statement, comment); }) {
      write_block(out, statement, comment);
    } else {
      write_block(out, statement);
    }
  };
  if (!block.is<Empty>()) {
    out.write(separator);
    std::visit(write, block.statement);
    separator = " ";
  }
  if (!block.comment_mark || block.is<Cycle>()) return;
  out.write(separator).write(";").write(comment);
}

std::string print_blocks(const Program& program, bool renumbers) {
  std::string text;
  text.reserve(program.source().size() + (renumbers ? program.blocks().size() * 4 : 0));
  BlockWriter out(program, text);
  std::uint32_t count = 0;
  for (const Block& block : program.blocks()) {
    const bool has_number = renumbers || block.has_number;
    const std::uint32_t number = renumbers ? count++ : block.number;
    print_block(out, program, block, has_number ? std::optional(number) : std::nullopt);
    out.write("\n");
  }
  return text;
}

}  // namespace

std::string print_program(const Program& program) { return print_blocks(program, false); }

std::string format_program(const Program& program) { return print_blocks(program, true); }

std::string print_statement(const Program& program, const Block& block) {
  Block bare = block;
  bare.skip = false;
  bare.comment_mark &= block.is<Cycle>();
  std::string text;
  BlockWriter out(program, text);
  print_block(out, program, bare, std::nullopt);
  return text;
}

}  // namespace fitgauge::klartext

#include "nc/klartext/statement_writer.hpp"

#include "nc/klartext/operator_names.hpp"

/// Blocks other than cycles and functions: frame, tools, motion, flow, transformations.
namespace fitgauge::klartext {
namespace {

void write_unit(BlockWriter& out, Text name, Unit unit) {
  out.write(name);
  if (!name.empty()) out.write(" ");
  out.write(unit == Unit::Inch ? "INCH" : "MM");
}

std::string_view name_of(Axis axis) { return spelling(letter_of(axis)); }

/// Feeds and M functions end a positioning block; the compensation stands before them.
constexpr LetterSet kFeedsAndM(Letter::F, Letter::FMax, Letter::FAuto, Letter::Fu, Letter::Fz,
                               Letter::Ft, Letter::FMaxT, Letter::M);

}  // namespace

void write_block(BlockWriter&, const Empty&) {}

void write_block(BlockWriter& out, const BeginProgram& begin) {
  out.write("BEGIN PGM ");
  write_unit(out, begin.name, begin.unit);
}

void write_block(BlockWriter& out, const EndProgram& end) {
  out.write("END PGM ");
  write_unit(out, end.name, end.unit);
}

void write_block(BlockWriter& out, const Structure& structure) {
  out.write("*").write(std::string(1 + 2 * std::size_t{structure.level}, ' ')).write("- ");
  out.write(structure.text);
}

void write_block(BlockWriter& out, const ErrorBlock& error) {
  out.write("ERROR = ").write(error.text);
}

void write_block(BlockWriter& out, const Unsupported& unsupported) { out.write(unsupported.text); }

void write_block(BlockWriter& out, const BlankForm& form) {
  constexpr std::string_view kNames[] = {"0.1", "0.2", "CYLINDER", "ROTATION", "FILE"};
  out.write("BLK FORM ").write(kNames[static_cast<std::size_t>(form.kind)]);
  if (form.tool_axis) out.write(" ").write(name_of(*form.tool_axis));
  if (!is_absent(form.file)) out.write(" ").value(form.file);
  out.words(form.words);
}

void write_block(BlockWriter& out, const ToolCall& call) {
  out.write("TOOL CALL");
  if (!is_absent(call.tool)) out.write(" ").value(call.tool);
  if (call.axis) out.write(" ").write(name_of(*call.axis));
  out.words(call.words);
}

void write_block(BlockWriter& out, const ToolDefinition& definition) {
  out.write("TOOL DEF ").value(definition.tool).words(definition.words);
}

void write_block(BlockWriter& out, const Motion& motion) {
  constexpr std::string_view kCompensations[] = {"", " R0", " RL", " RR", " R+", " R-"};
  constexpr std::string_view kRotations[] = {"", " DR+", " DR-"};
  out.write(kPaths[static_cast<std::size_t>(motion.path)]);
  std::string marks(kRotations[static_cast<std::size_t>(motion.rotation)]);
  marks += kCompensations[static_cast<std::size_t>(motion.compensation)];
  out.words(motion.words, marks, kFeedsAndM);
}

void write_block(BlockWriter& out, const MFunctions& functions) {
  std::string_view separator;
  for (const Word& word : out.program().view(functions.words)) {
    out.write(separator).word(word);
    separator = " ";
  }
}

void write_block(BlockWriter& out, const Trans& trans) {
  constexpr std::string_view kNames[] = {"DATUM", "DATUM TABLE", "MIRROR", "ROTATION", "SCALE"};
  out.write("TRANS ").write(kNames[static_cast<std::size_t>(trans.kind)]);
  const bool axes = trans.kind == Transformation::Datum || trans.kind == Transformation::Mirror;
  if (trans.reset) {
    out.write(" RESET");
  } else if (axes) {
    out.write(" AXIS");
  }
  if (!is_absent(trans.table)) out.write(" ").value(trans.table);
  out.words(trans.words);
}

void write_block(BlockWriter& out, const Plane& plane) {
  constexpr LetterSet kBehind =
      kFeedsAndM | LetterSet(Letter::Mb, Letter::MbMax, Letter::Dist, Letter::Seq, Letter::Sym,
                             Letter::TableRot, Letter::CoordRot);
  out.write("PLANE ").write(kPlaneKinds[static_cast<std::size_t>(plane.kind)]);
  const std::string_view how = kPlanePositionings[static_cast<std::size_t>(plane.positioning)];
  std::string mark(how.empty() ? "" : " ");
  mark += how;
  out.words(plane.words, mark, kBehind);
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
  out.write("FUNCTION MODE ").write(kOperatingModes[static_cast<std::size_t>(mode.mode)]);
  if (mode.kinematics.empty()) return;
  out.write(" ").quoted(mode.kinematics);
}

void write_block(BlockWriter& out, const FunctionTcpm& tcpm) {
  out.write(tcpm.active ? "FUNCTION TCPM " : "FUNCTION RESET TCPM").write(tcpm.options);
}

}  // namespace fitgauge::klartext

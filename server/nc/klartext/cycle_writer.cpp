#include "nc/klartext/statement_writer.hpp"

namespace fitgauge::klartext {
namespace {

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

}  // namespace

void write_cycle(BlockWriter& out, const Cycle& cycle, std::string_view first_comment) {
  write_head(out, cycle.family, cycle.number);
  if (!cycle.dialog.empty()) out.write(" ").write(cycle.dialog);
  const auto write_comment = [&](std::string_view comment) {
    if (comment.empty()) return;
    out.write(" ;");
    out.write(comment);
  };
  write_comment(first_comment);
  for (const CycleParameter& parameter : out.program().view(cycle.parameters)) {
    out.write(" ~\n    ").parameter(parameter.parameter).write("=");
    write_value(out, parameter);
    write_comment(out.program().text(parameter.comment));
  }
}

void write_block(BlockWriter& out, const Cycle& cycle) { write_cycle(out, cycle, {}); }

void write_block(BlockWriter& out, const CyclePart& part) {
  write_head(out, part.family, part.number);
  out.write(".").write(std::to_string(part.part));
  if (part.text.empty()) return;
  out.write(" ").write(part.text);
}

void write_block(BlockWriter& out, const CycleCall& call) {
  constexpr std::string_view kKinds[] = {"", " PAT", " POS"};
  out.write("CYCL CALL").write(kKinds[static_cast<std::size_t>(call.kind)]).words(call.words);
}

}  // namespace fitgauge::klartext

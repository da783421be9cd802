#include "nc/klartext/printer.hpp"

#include "nc/klartext/forms.hpp"

namespace fitgauge::klartext {
namespace {

void print_block(BlockWriter& out, const Program& program, const Block& block,
                 std::optional<std::uint32_t> number) {
  std::string_view separator;
  if (block.skip) out.write("/");
  if (number) {
    out.write(std::to_string(*number));
    separator = " ";
  }
  const std::string_view comment = program.text(block.comment);
  if (const auto* cycle = std::get_if<Cycle>(&block.statement)) {
    out.write(separator);
    write_cycle(out, *cycle, comment);
    return;
  }
  if (!std::holds_alternative<Empty>(block.statement)) {
    out.write(separator);
    std::visit([&](const auto& statement) { write_block(out, statement); }, block.statement);
    separator = " ";
  }
  if (!block.comment_mark) return;
  out.write(separator).write(";");
  out.write(comment);
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
  bare.comment_mark &= std::holds_alternative<Cycle>(block.statement);
  std::string text;
  BlockWriter out(program, text);
  print_block(out, program, bare, std::nullopt);
  return text;
}

}  // namespace fitgauge::klartext

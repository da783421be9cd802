#include "klartext/syntax.hpp"

#include <algorithm>
#include <iterator>

namespace fitgauge::klartext {
namespace {

std::uint32_t characters(std::string_view utf8) {
  return static_cast<std::uint32_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

SourcePosition position(const ProgramParts& parts, std::size_t offset) {
  const auto& starts = parts.line_starts;
  if (starts.empty()) return {};
  const auto next = std::upper_bound(starts.begin() + 1, starts.end(), offset);
  const std::uint32_t start = *std::prev(next);
  return {.line = static_cast<std::uint32_t>(next - starts.begin()),
          .column = characters(std::string_view(parts.source).substr(start, offset - start)) + 1};
}

/// Comments may stand before BEGIN PGM.
const BeginProgram* begin_of(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) {
    if (const auto* begin = std::get_if<BeginProgram>(&block.statement)) return begin;
    if (!std::holds_alternative<Empty>(block.statement)) break;
  }
  return nullptr;
}

}  // namespace

SourceRange Program::range(Slice<char> place) const {
  return {position(parts_, place.first), position(parts_, std::size_t{place.first} + place.count)};
}

std::string_view Program::line(std::uint32_t number) const {
  const auto& starts = parts_.line_starts;
  if (number == 0 || number > starts.size()) return {};
  const std::string_view rest = source().substr(starts[number - 1]);
  return rest.substr(0, rest.find('\n'));
}

Unit Program::unit() const {
  const BeginProgram* begin = begin_of(parts_.blocks);
  return begin != nullptr ? begin->unit : Unit::Millimetre;
}

std::string_view Program::name() const {
  const BeginProgram* begin = begin_of(parts_.blocks);
  return begin != nullptr ? text(begin->name) : std::string_view();
}

bool operator==(const Program& a, const Program& b) {
  // The pools are filled in the order of the source: equal programs have equal pools.
  const ProgramParts& x = a.parts_;
  const ProgramParts& y = b.parts_;
  return x.blocks == y.blocks && x.words == y.words && x.cycle_parameters == y.cycle_parameters &&
         x.nodes == y.nodes && x.operands == y.operands && x.texts == y.texts;
}

}  // namespace fitgauge::klartext

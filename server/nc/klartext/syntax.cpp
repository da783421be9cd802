#include "nc/klartext/syntax.hpp"

#include "nc/klartext/source_text.hpp"

namespace fitgauge::klartext {
namespace {

/// Comments may precede BEGIN PGM.
const BeginProgram* begin_of(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) {
    if (const auto* begin = std::get_if<BeginProgram>(&block.statement)) return begin;
    if (!std::holds_alternative<Empty>(block.statement)) break;
  }
  return nullptr;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& pool) {
  return sizeof(T) * pool.size();
}

}  // namespace

std::size_t ProgramParts::memory_bytes() const {
  constexpr std::size_t kGrown = 2;
  return source.size() + bytes_of(line_starts) + bytes_of(blocks) + bytes_of(words) +
         kGrown *
             (bytes_of(cycle_parameters) + bytes_of(nodes) + bytes_of(operands) + texts.size());
}

Program Program::translated(std::string&& source,
                            const std::function<Slice<char>(Slice<char>)>& place) && {
  for (Block& block : parts_.blocks) block.written = place(block.written);
  for (CycleParameter& row : parts_.cycle_parameters) row.written = place(row.written);
  parts_.source = std::move(source);
  parts_.line_starts = {0};
  for (std::size_t at = parts_.source.find('\n'); at != std::string::npos;
       at = parts_.source.find('\n', at + 1)) {
    parts_.line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  }
  return std::move(*this);
}

SourceRange Program::range(Slice<char> place) const {
  return {position_of(parts_.source, parts_.line_starts, place.first),
          position_of(parts_.source, parts_.line_starts, std::size_t{place.first} + place.count)};
}

std::string_view Program::line(std::uint32_t number) const {
  return line_of(parts_.source, parts_.line_starts, number);
}

Unit Program::unit() const {
  const BeginProgram* begin = begin_of(parts_.blocks);
  return begin != nullptr ? begin->unit : Unit::Millimetre;
}

std::string_view Program::name() const {
  const BeginProgram* begin = begin_of(parts_.blocks);
  return begin != nullptr ? text(begin->name) : std::string_view();
}

}  // namespace fitgauge::klartext

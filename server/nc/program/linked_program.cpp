#include "nc/program/linked_program.hpp"

#include "base/text.hpp"

namespace fitgauge::interpreter {
namespace {

template <class Map, class Key>
std::optional<std::uint32_t> lookup(const Map& map, const Key& key) {
  const auto it = map.find(key);
  return it == map.end() ? std::nullopt : std::optional(it->second);
}

}  // namespace

std::optional<std::uint32_t> LinkedProgram::instruction_of(std::uint32_t block_number) const {
  const auto& blocks = program_.blocks();
  const auto block = std::ranges::find(blocks, block_number, &klartext::Block::number);
  if (block == blocks.end()) return std::nullopt;
  const auto index = static_cast<std::uint32_t>(block - blocks.begin());
  const auto first = std::ranges::lower_bound(parts_.block_of, index);
  return static_cast<std::uint32_t>(first - parts_.block_of.begin());
}

std::optional<std::uint32_t> LinkedParts::label(std::uint32_t number) const {
  return lookup(numbered_labels, number);
}

std::optional<std::uint32_t> LinkedParts::label(std::string_view name) const {
  return lookup(named_labels, ascii_upper(name));
}

}  // namespace fitgauge::interpreter

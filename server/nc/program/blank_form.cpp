#include "nc/program/link_check.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::BlankForm;
using klartext::BlankKind;

constexpr std::size_t kMostSearched = 1'000;

bool is_lower_corner(const klartext::Block& block) {
  const auto* blank = std::get_if<BlankForm>(&block.statement);
  return blank != nullptr && blank->kind == BlankKind::Minimum;
}

/// The block of the last BLK FORM 0.1 before a block, or null.
const klartext::Block* lower_corner(const Program& program, const klartext::Block& block) {
  const klartext::Block* at = &block;
  for (std::size_t passed = 0; passed < kMostSearched && at != program.blocks().data(); ++passed) {
    if (is_lower_corner(*--at)) return at;
  }
  return nullptr;
}

}  // namespace

bool has_lower_corner(const Program& program) {
  const auto blocks = program.blocks();
  return std::ranges::any_of(blocks.first(std::min(blocks.size(), kMostSearched)), is_lower_corner);
}

std::vector<std::string> blank_faults(const Program& program, const klartext::Block& block,
                                      const BlankValue& value) {
  const auto* blank = std::get_if<BlankForm>(&block.statement);
  if (blank == nullptr) return {};
  const auto words = program.view(blank->words);
  if (blank->kind == BlankKind::Minimum && std::ranges::any_of(words, &Word::incremental))
    return {"the lower corner of the blank must be absolute: there is no position before it"};
  if (blank->kind != BlankKind::Maximum) return {};
  const klartext::Block* least = lower_corner(program, block);
  if (least == nullptr) return {std::string(kNoLowerCorner)};
  const bool is_next = least + 1 == &block;  // else parameters may have other values by now
  const auto number = [&](const Expr& written) {
    if (const auto* literal = std::get_if<double>(&written)) return std::optional(*literal);
    return is_next ? value(written) : std::nullopt;
  };
  std::vector<std::string> faults;
  for (const Word& word : words) {
    for (const Word& below : program.view(std::get<BlankForm>(least->statement).words)) {
      if (word.letter != below.letter) continue;
      const auto written = number(word.value);
      const auto lower = number(below.value);
      if (!written || !lower) continue;
      const double upper = word.incremental ? *lower + *written : *written;
      if (upper > *lower) continue;
      const auto letter = klartext::spelling(word.letter);
      faults.push_back(fmt::format(
          "the upper corner of the blank must lie above the lower one: {}{:+g} and {}{:+g}", letter,
          upper, letter, *lower));
    }
  }
  return faults;
}

bool may_have_blank_fault(const Program& program, const klartext::Block& block) {
  bool depends = false;
  const auto ask = [&](const Expr&) {
    depends = true;
    return std::optional<double>();
  };
  return !blank_faults(program, block, ask).empty() || depends;
}

}  // namespace fitgauge::interpreter

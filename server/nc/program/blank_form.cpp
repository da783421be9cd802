#include "nc/program/blank_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nc/klartext/word_names.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::BlankForm;
using klartext::BlankKind;

/// The last BLK FORM 0.1 before a block, or null.
const BlankForm* lower_corner(const klartext::Program& program, const klartext::Block& block) {
  constexpr int kMostBetween = 1'000;
  const klartext::Block* at = &block;
  for (int passed = 0; passed < kMostBetween && at != program.blocks().data(); ++passed) {
    const auto* blank = std::get_if<BlankForm>(&(--at)->statement);
    if (blank != nullptr && blank->kind == BlankKind::Minimum) return blank;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> blank_faults(const klartext::Program& program,
                                      const klartext::Block& block) {
  const auto* blank = std::get_if<BlankForm>(&block.statement);
  if (blank == nullptr) return {};
  const auto words = program.view(blank->words);
  if (blank->kind == BlankKind::Minimum && std::ranges::any_of(words, &klartext::Word::incremental))
    return {"the lower corner of the blank must be absolute: there is no position before it"};
  if (blank->kind != BlankKind::Maximum) return {};
  const BlankForm* least = lower_corner(program, block);
  if (least == nullptr) return {"BLK FORM 0.2 stands without BLK FORM 0.1 before it"};
  std::vector<std::string> faults;
  for (const klartext::Word& word : words) {
    for (const klartext::Word& below : program.view(least->words)) {
      const auto* written = std::get_if<double>(&word.value);
      const auto* lower = std::get_if<double>(&below.value);
      if (word.letter != below.letter || written == nullptr || lower == nullptr) continue;
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

}  // namespace fitgauge::interpreter

#include "nc/klartext/word_names.hpp"

namespace fitgauge::klartext {
namespace {

/// In the order of Letter.
constexpr std::string_view kSpellings[] = {
#define FITGAUGE_LETTER(letter, spelling) spelling,
#include "nc/klartext/letters.inc"
#undef FITGAUGE_LETTER
};
static_assert(std::size(kSpellings) <= 128, "LetterSet holds 128 letters");

/// The rows of names that begin with each character, so that a look-up compares few.
constexpr std::array<Letter, 26> kFirstRow = [] {
  std::array<Letter, 26> first{};
  first.fill(static_cast<Letter>(std::size(kSpellings)));
  for (std::size_t i = std::size(kSpellings); i > 0; --i) {
    const std::string_view name = kSpellings[i - 1];
    if (!name.empty()) first[static_cast<std::size_t>(name[0] - 'A')] = static_cast<Letter>(i - 1);
  }
  return first;
}();

}  // namespace

constinit const std::array<Letter, 26> kSingleLetters = [] {
  std::array<Letter, 26> singles{};
  singles.fill(Letter::Value);
  for (std::size_t i = 0; i < std::size(kSpellings); ++i) {
    const std::string_view name = kSpellings[i];
    if (name.size() == 1) singles[static_cast<std::size_t>(name[0] - 'A')] = static_cast<Letter>(i);
  }
  return singles;
}();

std::optional<Letter> find_letter(std::string_view letters) {
  if (letters.empty()) return std::nullopt;
  if (letters.size() == 1) {
    const Letter letter = single_letter(letters.front());
    return letter == Letter::Value ? std::nullopt : std::optional(letter);
  }
  const auto initial = static_cast<std::size_t>(ascii_upper(letters.front()) - 'A');
  for (auto i = static_cast<std::size_t>(kFirstRow[initial]); i < std::size(kSpellings); ++i) {
    if (ascii_iequals(kSpellings[i], letters)) return static_cast<Letter>(i);
  }
  return std::nullopt;
}

std::string_view spelling(Letter letter) { return kSpellings[static_cast<std::size_t>(letter)]; }

bool is_bare(Letter letter) {
  constexpr LetterSet kBare(Letter::FMax, Letter::FAuto, Letter::FMaxT, Letter::MbMax, Letter::DimR,
                            Letter::DimD, Letter::TableRot, Letter::CoordRot);
  return kBare.contains(letter);
}

}  // namespace fitgauge::klartext

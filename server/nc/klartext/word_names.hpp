#pragma once

#include "nc/klartext/expression.hpp"

/// Words and their spellings, which the parser and the printer share.
namespace fitgauge::klartext {

enum class Axis : std::uint8_t { X, Y, Z, A, B, C, U, V, W };

/// The address of a word. The axes come first, in the order of Axis.
enum class Letter : std::uint8_t {
#define FITGAUGE_LETTER(letter, spelling) letter,
#include "nc/klartext/letters.inc"
#undef FITGAUGE_LETTER
};

inline bool is_axis(Letter letter) { return letter <= Letter::W; }
inline Axis axis_of(Letter letter) { return static_cast<Axis>(letter); }
inline Letter letter_of(Axis axis) { return static_cast<Letter>(axis); }

/// One word of a block: `X+10`, `IZ-Q5`, `FMAX`, `M91`. Words keep the order written.
struct Word {
  /// Absent if the letter has no value: `CYCL DEF 8.1 X Y`, `M118 X`. A probing direction `X-` of
  /// TCH PROBE 0.0 is +1 or -1. Derived data uses its last bytes.
  [[no_unique_address]] Expr value{};
  Letter letter = Letter::X;
  bool incremental = false;  ///< `IX`, `IPA`, `IROT`
  bool argument = false;     ///< belongs to the M function before it: `M140 MB50`, `M128 F1000`
};

static_assert(sizeof(Word) == 16, "a long program has three words a block");

/// A set of letters: the allowed words of a block.
class LetterSet {
 public:
  constexpr LetterSet() = default;
  template <class... Letters>
  constexpr explicit LetterSet(Letters... letters) {
    (insert(letters), ...);
  }

  constexpr void insert(Letter letter) { bits_[index(letter)] |= bit(letter); }
  constexpr bool contains(Letter letter) const { return (bits_[index(letter)] & bit(letter)) != 0; }
  constexpr void erase(Letter letter) { bits_[index(letter)] &= ~bit(letter); }
  friend constexpr LetterSet operator&(LetterSet a, LetterSet b) {
    a.bits_[0] &= b.bits_[0];
    a.bits_[1] &= b.bits_[1];
    return a;
  }
  friend constexpr LetterSet operator|(LetterSet a, LetterSet b) {
    a.bits_[0] |= b.bits_[0];
    a.bits_[1] |= b.bits_[1];
    return a;
  }

 private:
  static constexpr unsigned index(Letter letter) { return static_cast<unsigned>(letter) / 64; }
  static constexpr std::uint64_t bit(Letter letter) {
    return std::uint64_t{1} << (static_cast<unsigned>(letter) % 64);
  }

  std::uint64_t bits_[2] = {0, 0};
};

/// The word of each letter from `A`; Letter::Value if there is none.
extern const std::array<Letter, 26> kSingleLetters;

/// Returns the letter of a word, in upper or lower case; none if there is no such word. Words with
/// other characters (`DR2`, `P1X`, `#`) are not found here.
std::optional<Letter> find_letter(std::string_view letters);
/// Finds a letter by a word of one letter; Letter::Value if there is none.
inline Letter single_letter(char c) {
  const auto i = static_cast<unsigned char>((c | 0x20) - 'a');
  return i < 26 ? kSingleLetters[i] : Letter::Value;
}

/// The spelling of a letter: `X`, `FMAX`, `MB MAX`; empty for a bare value.
std::string_view spelling(Letter letter);

/// Letters that never have a value: `FMAX`, `MB MAX`, `TABLE ROT`.
bool is_bare(Letter letter);

}  // namespace fitgauge::klartext

#pragma once

#include <cstdint>

#include "nc/klartext/expression.hpp"

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
  /// Absent where the letter stands alone: `CYCL DEF 8.1 X Y`, `M118 X`. A probing direction `X-`
  /// of TCH PROBE 0.0 is +1 or -1. What follows lies in its last bytes.
  [[no_unique_address]] Expr value{};
  Letter letter = Letter::X;
  bool incremental = false;  ///< `IX`, `IPA`, `IROT`
  bool argument = false;     ///< belongs to the M function before it: `M140 MB50`, `M128 F1000`

  friend bool operator==(const Word&, const Word&) = default;
};

static_assert(sizeof(Word) == 16, "a long program has three words a block");

}  // namespace fitgauge::klartext

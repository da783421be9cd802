#pragma once

#include <cstdint>

#include "nc/klartext/expression.hpp"

namespace fitgauge::klartext {

enum class Axis : std::uint8_t { X, Y, Z, A, B, C, U, V, W };

/// The address of a word. The axes come first, in the order of Axis.
enum class Letter : std::uint8_t {
  X,
  Y,
  Z,
  A,
  B,
  C,
  U,
  V,
  W,
  // vectors of LN and PLANE VECTOR
  Nx,
  Ny,
  Nz,
  Tx,
  Ty,
  Tz,
  Bx,
  By,
  Bz,
  // polar coordinates, radii and lengths of contour elements
  Pr,
  Pa,
  R,
  Len,
  Cca,
  Chamfer,  ///< the length of CHF, written without an address
  // feed
  F,
  FMax,   ///< no value
  FAuto,  ///< no value
  Fu,
  Fz,
  Ft,
  FMaxT,
  // tool data, spindle and M functions
  S,
  Dl,
  Dr,
  Dr2,
  L,  ///< tool length of TOOL DEF, length of BLK FORM CYLINDER
  M,  ///< the number of an M function; its arguments follow with `argument` set
  Mb,
  MbMax,  ///< `MB MAX`, no value
  La,
  T,
  // workpiece blank
  D,
  Dist,
  Ri,
  Label,  ///< a number, a Text or a parameter
  DimR,   ///< no value
  DimD,   ///< no value
  Target,
  // coordinate transformations and dotted cycles
  Rot,
  Scl,
  Ccx,
  Ccy,
  Ccz,
  Ta,
  HscMode,
  Row,      ///< `#5`, `TABLINE5`
  Program,  ///< `12.1 PGM path`: a Text or a QS parameter
  Result,   ///< a parameter that takes a result: `TCH PROBE 0.0 ... Q5`
  Value,    ///< a number after dialog text in a dotted cycle: `9.1 DWELL 0.5`
  // PLANE
  Spa,
  Spb,
  Spc,
  ProPr,
  ProMin,
  EulPr,
  EulNu,
  EulRot,
  P1x,
  P1y,
  P1z,
  P2x,
  P2y,
  P2z,
  P3x,
  P3y,
  P3z,
  Seq,       ///< +1 or -1
  Sym,       ///< +1 or -1
  TableRot,  ///< no value
  CoordRot,  ///< no value
  // PATTERN DEF
  Element,  ///< what the words after it define, as a PatternElement; its own number is a Value
  Num,
  NumX,
  NumY,
  Dx,
  Dy,
  RotX,
  RotY,
  Start,
  Step
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

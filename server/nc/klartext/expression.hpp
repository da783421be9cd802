#pragma once

#include "base/small_set.hpp"

/// Expressions as values: leaves are stored in place, inner nodes and texts in pools of the
/// Program, so that an expression needs no allocation and can be copied freely.
namespace fitgauge::klartext {

/// A run of elements in one of the Program's pools; `Program::view` gives the elements.
template <class T>
struct Slice {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  friend bool operator==(Slice, Slice) = default;
};

/// A decoded text in the Program's pool (no quotes, no `~`); `Program::text` gives its characters.
struct Text {
  std::uint32_t first = 0;
  std::uint32_t size = 0;

  bool empty() const { return size == 0; }
  friend bool operator==(Text, Text) = default;
};

/// The parameter spaces of the control and their first invalid numbers.
enum class QSpace : std::uint8_t {
  Q,   ///< global numbers, 0 to 1999
  Ql,  ///< local to the program, 0 to 499
  Qr,  ///< remanent, 0 to 499
  Qs   ///< strings, 0 to 1999
};

constexpr std::uint16_t parameter_count(QSpace space) {
  return space == QSpace::Q || space == QSpace::Qs ? 2000 : 500;
}

/// A parameter as named in the program: `Q5`, `QL3`, `QR12`, `QS1`. The number is in range.
struct QRef {
  QSpace space = QSpace::Q;
  std::uint16_t number = 0;

  bool is_string() const { return space == QSpace::Qs; }
  friend bool operator==(QRef, QRef) = default;
};

/// Maximum number of characters (code points) of a QS.
inline constexpr std::size_t kLongestString = 255;

/// The index of a Node in the Program's pool.
struct NodeIndex {
  std::uint32_t value = 0;

  friend bool operator==(NodeIndex, NodeIndex) = default;
};

using Absent = std::monostate;

/// A value that is computed when its block runs. Absent if the block omits an optional value. A
/// literal's sign is part of its number; `-Q5` is a Node.
using Expr = std::variant<Absent, double, QRef, Text, NodeIndex>;

inline bool is_absent(const Expr& expr) { return std::holds_alternative<Absent>(expr); }

/// Whether a leaf is a text: in double quotes or a QS parameter.
inline bool is_text(const Expr& expr) {
  const auto* parameter = std::get_if<QRef>(&expr);
  return std::holds_alternative<Text>(expr) || (parameter != nullptr && parameter->is_string());
}

/// Operations of a Node on its operands, in the order written. Angles are in degrees.
enum class Operator : std::uint8_t {
  // two numbers; FN 1 to 4, FN 8 and FN 13 are lowered to these too
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Power,
  Length,  ///< FN 8 LEN: the root of the sum of both squares
  Angle,   ///< FN 13 ANG: of `opposite ANG adjacent`, 0 to 360
  // one number
  Minus,  ///< the algebraic sign of a parameter or a parenthesis
  Sq,
  Sqrt,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Ln,
  Log,
  Exp,
  Neg,
  Abs,
  Int,
  Frac,
  Sgn,
  // no operand
  Pi,
  // strings; an operand that is not written is Absent
  Concat,         ///< two strings
  ToChar,         ///< DAT (number), DECIMALS (number)
  SubString,      ///< SRC (string), BEG, LEN (numbers)
  ToNumber,       ///< SRC
  InString,       ///< SRC, SEA (strings), BEG (number)
  StringLength,   ///< SRC
  StringCompare,  ///< SRC, SEA
  SystemString,   ///< ID, NR (numbers)
  // system data and tables
  SystemRead,     ///< FN 18: ID, NR, IDX (numbers)
  SystemAddress,  ///< FN 17: ID, NR, IDX; not a value, the place written to
  TableCell,      ///< FN 27 and 28: row (number), column names (string: "X,Y")
  // conditions of FN 9 to 12
  Equal,
  NotEqual,
  Greater,
  Less,
  IsDefined,   ///< one parameter
  IsUndefined  ///< one parameter
};

/// Whether an operation gives a text.
constexpr bool gives_text(Operator op) {
  return op == Operator::Concat || op == Operator::ToChar || op == Operator::SubString ||
         op == Operator::SystemString;
}

/// The deepest tree the parser builds; a recursive walk is safe.
inline constexpr std::uint16_t kDeepestExpression = 200;

/// An inner node of an expression tree. Its operands have smaller indices: they were parsed before.
struct Node {
  Operator op = Operator::Pi;
  std::uint16_t height = 1;  ///< of the tree below it, at most kDeepestExpression
  Slice<Expr> operands{};
};

// Words and their spellings, which the parser and the printer share.

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

/// The allowed words of a block.
using LetterSet = SmallSet<Letter>;

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

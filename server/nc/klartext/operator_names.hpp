#pragma once

#include "nc/klartext/lexer.hpp"
#include "nc/klartext/statement.hpp"

/// The spellings of operators and statements, which the parser and the printer share. A list of
/// statements is in the order of its enumeration.
namespace fitgauge::klartext {

inline constexpr std::string_view kPaths[] = {
#define FITGAUGE_PATH(path, spelling, words) spelling,
#include "nc/klartext/paths.inc"
#undef FITGAUGE_PATH
};

inline constexpr std::string_view kBlankKinds[] = {"0.1", "0.2", "CYLINDER", "ROTATION", "FILE"};
inline constexpr std::string_view kPlaneKinds[] = {"SPATIAL", "PROJECTED", "EULER", "VECTOR",
                                                   "POINTS",  "RELATIV",   "AXIAL", "RESET"};
inline constexpr std::string_view kPlanePositionings[] = {"", "TURN", "MOVE", "STAY"};
inline constexpr std::string_view kPatternElements[] = {"POS",   "ROW",  "PAT",
                                                        "FRAME", "CIRC", "PITCHCIRC"};

/// The value of an enumeration whose name is the next word; the names begin with `first`.
template <class Enumeration, std::size_t N>
std::optional<Enumeration> accept_name(Lexer& in, const std::string_view (&names)[N],
                                       Enumeration first = {}) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!names[i].empty() && in.accept_word(names[i]))
      return static_cast<Enumeration>(static_cast<std::size_t>(first) + i);
  }
  return std::nullopt;
}

/// The place of an operator in a list of names that begins with `first`.
constexpr std::size_t place_of(Operator op, Operator first) {
  return static_cast<std::size_t>(op) - static_cast<std::size_t>(first);
}

/// Functions of one number in a formula, from Operator::Sq on.
inline constexpr std::string_view kFunctions[] = {"SQ",   "SQRT", "SIN",  "COS", "TAN", "ASIN",
                                                  "ACOS", "ATAN", "LN",   "LOG", "EXP", "NEG",
                                                  "ABS",  "INT",  "FRAC", "SGN"};
static_assert(std::size(kFunctions) == place_of(Operator::Pi, Operator::Sq));

/// An argument of a function of texts: `SRC_QS10`, `BEG2`.
struct StringArgument {
  std::string_view prefix;
  bool string = false;  ///< a text, not a number
  bool required = true;
};

struct StringFunction {
  Operator op;
  std::string_view name;
  std::size_t argument_count;
  StringArgument arguments[3];
};

inline constexpr StringFunction kStringFunctions[] = {
    {Operator::ToChar, "TOCHAR", 2, {{.prefix = "DAT"}, {.prefix = "DECIMALS", .required = false}}},
    {Operator::SubString,
     "SUBSTR",
     3,
     {{.prefix = "SRC_", .string = true}, {.prefix = "BEG"}, {.prefix = "LEN"}}},
    {Operator::ToNumber, "TONUMB", 1, {{.prefix = "SRC_", .string = true}}},
    {Operator::InString,
     "INSTR",
     3,
     {{.prefix = "SRC_", .string = true},
      {.prefix = "SEA_", .string = true},
      {.prefix = "BEG", .required = false}}},
    {Operator::StringLength, "STRLEN", 1, {{.prefix = "SRC_", .string = true}}},
    {Operator::StringCompare,
     "STRCOMP",
     2,
     {{.prefix = "SRC_", .string = true}, {.prefix = "SEA_", .string = true}}},
    {Operator::SystemString, "SYSSTR", 2, {{.prefix = "ID"}, {.prefix = "NR"}}},
};

/// Comparisons of FN 9 to 12, from Operator::Equal on.
inline constexpr std::string_view kComparisons[] = {"EQU", "NE", "GT", "LT"};
inline constexpr unsigned kFirstComparison = 9;

/// FN 1 to 8 and 13: the function and the words between or before its operands.
struct ArithmeticFn {
  unsigned fn;
  Operator op;
  std::string_view sign;
  bool unary = false;
};

inline constexpr ArithmeticFn kArithmeticFns[] = {
    {.fn = 1, .op = Operator::Add, .sign = "+"},
    {.fn = 2, .op = Operator::Subtract, .sign = "-"},
    {.fn = 3, .op = Operator::Multiply, .sign = "*"},
    {.fn = 4, .op = Operator::Divide, .sign = "DIV"},
    {.fn = 5, .op = Operator::Sqrt, .sign = "SQRT", .unary = true},
    {.fn = 6, .op = Operator::Sin, .sign = "SIN", .unary = true},
    {.fn = 7, .op = Operator::Cos, .sign = "COS", .unary = true},
    {.fn = 8, .op = Operator::Length, .sign = "LEN"},
    {.fn = 13, .op = Operator::Angle, .sign = "ANG"},
};

constexpr const ArithmeticFn* find_arithmetic(unsigned fn) {
  for (const ArithmeticFn& row : kArithmeticFns) {
    if (row.fn == fn) return &row;
  }
  return nullptr;
}

}  // namespace fitgauge::klartext

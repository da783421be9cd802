#pragma once

#include "nc/klartext/diagnostic.hpp"

namespace fitgauge::klartext {

/// The dialog languages of the `L_` lines that a control here may have, and the others.
enum class MaskLanguage : std::uint8_t { English, German, Dutch, Italian, Polish, All, Other };

/// Values of a mask from the control instead of a parameter.
enum class MaskKeyword : std::uint8_t {
  CallPath,
  Hour,
  Minute,
  Second,
  Day,
  Month,
  MonthName,
  Year2,
  Year4
};

using MaskValue = std::variant<QRef, MaskKeyword>;

enum class MaskConversion : std::uint8_t {
  Float,      ///< `%9.4LF`, `%F`
  Integer,    ///< `%D`, `%I`: truncates
  String,     ///< `%S`
  RawString,  ///< `%RS`: without escapes, for paths
  Character   ///< `%C`: a character code
};

/// `%+9.4LF` with the value it shows.
struct MaskPlaceholder {
  MaskConversion conversion = MaskConversion::Float;
  bool plus = false;  ///< `+`: right-aligned
  bool left = false;  ///< `-`: left-aligned
  bool zero = false;  ///< `0`: filled with zeros
  int width = 0;      ///< characters including sign and point; 0 is as many as needed
  int decimals = -1;  ///< -1: not stated
  MaskValue value{};

  friend bool operator==(const MaskPlaceholder&, const MaskPlaceholder&) = default;
};

/// Literal text (escapes resolved) or a placeholder.
using MaskPiece = std::variant<std::string, MaskPlaceholder>;

/// `"text %9.4LF", Q1;`: one line of output.
struct MaskFormat {
  std::vector<MaskPiece> pieces{};
};

enum class MaskControlKind : std::uint8_t {
  Close,
  Append,
  AppendMax,
  Truncate,
  EmptyHide,
  EmptyShow
};

/// `M_CLOSE`, `M_APPEND_MAX20`, ...
struct MaskControl {
  MaskControlKind kind = MaskControlKind::Close;
  int kilobytes = 0;  ///< of AppendMax
};

struct MaskLine {
  std::uint32_t line = 1;  ///< in the file
  std::variant<MaskFormat, MaskControl, MaskLanguage> content{};
};

/// A mask of FN 16: F-PRINT. Immutable once parsed.
struct MaskFile {
  std::string file_name{};
  std::vector<MaskLine> lines{};
};

/// A larger file is refused with ProgramTooLarge: its lines need thirty times the memory of the
/// text.
inline constexpr std::size_t kLargestMask = std::size_t{1} << 20;

struct ParsedMask {
  MaskFile mask;
  std::vector<Diagnostic> diagnostics{};  ///< lines with an error are not in the mask
};

/// Reads a mask file; encodings as of parse_program. Never throws on bad input.
ParsedMask parse_mask(std::string bytes, std::string name);

}  // namespace fitgauge::klartext

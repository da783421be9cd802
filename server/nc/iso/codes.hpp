#pragma once

/// The codes of DIN/ISO blocks and their Klartext.
namespace fitgauge::iso {

enum class CodeKind : std::uint8_t {
  Path,          ///< how the tool moves; modal
  Compensation,  ///< of the tool's radius
  Plane,         ///< the tool axis of the block
  Dimension,     ///< absolute or incremental
  Block,         ///< a separate block, by its pattern
  Cycle,         ///< a cycle in Q-form
  Absent         ///< a code of real controls that is not available here
};

/// A pattern is Klartext with `|` between blocks. `$F` is the value of the word F, `$1` of P01,
/// `$p` all P values joined by `/`, `$w` all other words, `$t` the text after the code, `$q` the
/// parameter after the code, `$r` P01 as a parameter, `$a` the tool axis.
struct Code {
  unsigned number;
  CodeKind kind;
  std::string_view klartext;       ///< a word or pattern; for Absent the remedy
  std::string_view addition = {};  ///< of a path: FMAX, or the direction of rotation
};

/// @returns nullptr if there is no such code.
const Code* find_code(unsigned number);
/// All codes except cycles in Q-form, in the order of their numbers.
std::span<const Code> codes();

/// Pattern of a D function with P words; empty if the text of the Klartext function follows D.
std::string function_pattern(unsigned number);

/// The first words of a cycle in Q-form: `TCH PROBE` and 421. G120 to G128 are the cycles 20 to 28.
struct CycleHead {
  std::string_view family;
  unsigned number;
};
CycleHead cycle_head(unsigned code);

}  // namespace fitgauge::iso

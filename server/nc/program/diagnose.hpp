#pragma once

#include "nc/program/parameter.hpp"

namespace fitgauge::interpreter {

/// Maximum number of findings.
inline constexpr std::size_t kMostFindings = 200;

/// Makes a finding about a place of a program, up to the end of its first physical line.
Diagnostic diagnose(const Program& program, const klartext::Block& block, Slice<char> place,
                    Severity severity, DiagnosticCode code, std::string message);

/// Adds a finding unless there are too many. @returns it, or null
Diagnostic* report(std::vector<Diagnostic>& diagnostics, const Program& program,
                   const klartext::Block& block, Slice<char> place, Severity severity,
                   DiagnosticCode code, std::string message);

/// Where a parameter is written in the code of a place: not in comments and texts.
std::vector<Slice<char>> places_of(const Program& program, Slice<char> place, QRef parameter);

/// Adds the remedy to write the near word to the last finding.
void suggest(std::vector<Diagnostic>& diagnostics, std::string_view wrong,
             const SpellingHint& hint);

/// The only number that a place sets, as written: `Q275=+25`, `Q9 = +26`, `D00 Q9 P01 +26`.
std::optional<DiagnosticEdit> written_number(const Program& program, Slice<char> place);

/// Returns whether a comment of the program switches a note or warning off: `check:ignore`, with or
/// without codes, in its line or in the comment line above it; of a run, in a line of its block.
bool is_ignored(const Program& program, const Diagnostic& found);

/// The unit of a program in INCH as the cause of a finding.
DiagnosticNote inch_note(const Program& program);

/// The member of the setup that makes an M function or a cycle of the machine builder known, as a
/// hint in the messages of checks and runs.
std::string m_function_hint(int number);
std::string cycle_hint(bool is_probing, int number);

enum class MRole : std::uint8_t {
  Does,    ///< the run executes it
  Notes,   ///< the run reports that it leaves it out
  Ends,    ///< switches off the function in `text`, which the run does not simulate: no effect
  Refuses  ///< the run fails: positions would be wrong
};

struct MFunction {
  int number = 0;
  MRole role = MRole::Does;
  std::string_view text{};  ///< the missing effect and the reason; of Ends the number that it ends
};

/// The M functions of the control, by number.
std::span<const MFunction> m_functions();
/// Null for one that only a machine builder knows.
const MFunction* m_function(int number);
bool is_m_function(int number);

}  // namespace fitgauge::interpreter

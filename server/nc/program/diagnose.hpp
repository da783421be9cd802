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

// link_check.cpp
/// Whether a block does something when the program runs: comments, labels but LBL 0, a right BLK
/// FORM and all sub-lines of a dotted cycle but its last do not.
bool has_effect(const Program& program, std::uint32_t block);

/// Returns the block that opens the dotted cycle of the sub-line `block`; for other blocks `block`.
std::uint32_t first_part(const Program& program, std::uint32_t block);

/// Notes FN 18 of a program that gives nowhere what the run needs for it.
void check_system_needs(const Program& program, std::vector<Diagnostic>& diagnostics);

/// Reports faults of the cycle of a block (unknown or invalid parameters: errors; an unavailable
/// cycle: a warning) and unavailable M functions (warnings).
void check_block(const Program& program, std::uint32_t block, std::vector<Diagnostic>& diagnostics);

// contradictions.cpp
/// Adds warnings for contradictions in a program: a dialog text or comment that means another cycle
/// or parameter, depths and heights of the wrong sign or order, limits far from the nominal size, a
/// cutter or a turning spindle that probes, results that no cycle gives, parameters after a line
/// without `~`. A parameter with a known number counts as that number; the finding is at its
/// assignment. Then drops the findings that a comment switches off.
void check_contradictions(const Program& program, std::vector<Diagnostic>& diagnostics);

// diagnose.cpp
/// A fault of a program that no other calls: the caller may give the corner.
inline constexpr std::string_view kNoLowerCorner =
    "BLK FORM 0.2 stands without BLK FORM 0.1 before it";

/// Whether one of the first thousand blocks is a BLK FORM 0.1, for the programs that this one
/// calls.
bool has_lower_corner(const Program& program);

using BlankValue = std::function<std::optional<double>(const Expr&)>;

/// The faults of a BLK FORM 0.1 or 0.2 and its other corner. Empty for other blocks. @param
/// value of what is no number, or nothing if it is unknown
std::vector<std::string> blank_faults(const Program& program, const klartext::Block& block,
                                      const BlankValue& value);

/// Whether the block has a fault, or may have one with values of the run.
bool may_have_blank_fault(const Program& program, const klartext::Block& block);

// system_addresses.cpp
/// Whether this control has system data; without a number, whether it has any of the ID.
bool has_system_data(int id, std::optional<int> number, bool writes);

/// Whether data that need an index, most of them an axis, have this one.
bool has_index(int id, int number, std::optional<int> index);

/// What the run needs for data, beside their index.
enum class SystemNeed : std::uint8_t { Nothing, Cycle, Text, Probe, Touch };

SystemNeed need_of(int id, int number);

}  // namespace fitgauge::interpreter

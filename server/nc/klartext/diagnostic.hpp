#pragma once

#include "nc/klartext/expression.hpp"

namespace fitgauge::klartext {

enum class Severity : std::uint8_t {
  Note,     ///< the program runs as intended, but is not written as it should be
  Warning,  ///< the program runs; the named part fails only when its block is reached, or is
            ///< cosmetic
  Error     ///< the program is refused
};

/// `note`, `warning`, `error`.
std::string_view word(Severity severity);

enum class DiagnosticCode : std::uint8_t {
#define KLARTEXT_DIAGNOSTIC(name, id) name,
#include "nc/klartext/diagnostic_codes.inc"
};

/// The stable text of a code: `label.unknown`.
std::string_view id(DiagnosticCode code);

/// Another place of a finding.
struct DiagnosticNote {
  std::string message{};
  SourceRange range{};
  std::string program{};  ///< the file's name; empty: the file of the finding

  friend bool operator==(const DiagnosticNote&, const DiagnosticNote&) = default;
};

/// A change of the file, within one physical line.
struct DiagnosticEdit {
  SourceRange range{};
  std::string by{};
};

/// A way to put a finding right.
struct DiagnosticRemedy {
  std::string title{};
  std::vector<DiagnosticEdit> edits{};
  bool is_preferred = true;
};

/// One finding about a program or mask.
struct Diagnostic {
  Severity severity = Severity::Error;
  DiagnosticCode code = DiagnosticCode::SyntaxError;
  std::string message{};                 ///< the fault and its remedy
  std::string program{};                 ///< the file's name
  SourceRange range{};                   ///< columns in characters; within one physical line
  std::optional<std::uint32_t> block{};  ///< its number as written
  std::string source{};                  ///< the physical line
  bool is_unreadable = false;            ///< the line is not Klartext and becomes an ERROR block
  std::vector<DiagnosticNote> notes{};
  std::vector<DiagnosticRemedy> remedies{};
};

/// A line as findings show it: a longer one is cut, as two hundred findings in a line of megabytes
/// must stay small.
std::string_view shown(std::string_view line);

/// Returns whether one of them refuses the text. @param keeps_unreadable lines that are no Klartext
/// are ERROR blocks and no errors (decision 32).
bool has_errors(const std::vector<Diagnostic>& diagnostics, bool keeps_unreadable = false);

/// The findings of a text that is too large to be read.
std::vector<Diagnostic> too_large(std::string message, std::string name);

/// The finding as text of three lines:
/// `8255.h:14:9: error: label 5 is not defined [label.unknown]`, the line, and a caret below it.
std::string render(const Diagnostic& diagnostic);

/// Collects the findings of one text and places them. Keeps references to the text and its line
/// starts, which must know every line a finding is reported in. Single-threaded.
class DiagnosticList {
 public:
  DiagnosticList(const std::string& source, const std::vector<std::uint32_t>& line_starts,
                 std::string program)
      : source_(source), line_starts_(line_starts), program_(std::move(program)) {}

  /// @param instead the text that is right in this place; empty: not known
  void add(Severity severity, DiagnosticCode code, Slice<char> place, std::string message,
           std::optional<std::uint32_t> block = std::nullopt, bool is_unreadable = false,
           const std::string& instead = {});

  /// Returns the findings. If there were too many, the last one has the number of missing findings,
  /// and is an error if a missing one is.
  std::vector<Diagnostic> take();

 private:
  const std::string& source_;
  const std::vector<std::uint32_t>& line_starts_;
  std::string program_;
  std::vector<Diagnostic> kept_;
  std::size_t dropped_ = 0;
  Severity worst_dropped_ = Severity::Note;
  bool all_dropped_unreadable_ = true;  ///< of the errors
};

}  // namespace fitgauge::klartext

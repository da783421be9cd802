#pragma once

#include "cli/open_programs.hpp"
#include "nc/probing/cycle_descriptor.hpp"

/// The knowledge of the language server about a place of a program, in either dialect.

namespace fitgauge::cli {

/// The cycle whose block a line belongs to.
struct CycleAt {
  const probing::CycleDescriptor* cycle = nullptr;
  std::size_t first_line = 0;
  std::size_t dialog = 0;  ///< the column after its number
};
std::optional<CycleAt> cycle_at(const EditedText& text, std::size_t line);

/// `TCH PROBE 421`, or `G421`.
std::string head_of(const probing::CycleDescriptor& cycle, bool is_iso = false);
/// Returns the text that a control writes after a value.
std::string dialog_of(const probing::CycleParameter& parameter);
std::string_view without_wrap(std::string_view line);
/// Begin of the comment of a line; npos: none.
std::size_t comment_of(std::string_view line);

/// Parameters in a line of a program or mask; not in comments, texts and file names.
std::vector<WrittenParameter> parameters_of(const EditedText& text, std::size_t line);
std::optional<WrittenParameter> parameter_at(const EditedText& text, Place place);

/// Markdown: the cycle of a line with its parameters, units and results, or the meaning of a
/// parameter: in its cycle, as a result, or the lines that set it. May be empty.
std::string hover_text(const EditedText& text, Place place);

struct Completion {
  std::string label;
  std::string detail;
  Edit edit;  ///< its text is a snippet of LSP
};
/// Cycles with their parameters, in a cycle those that it lacks, and first words of blocks.
std::vector<Completion> completions(const EditedText& text, Place cursor);

/// Formats like `nc format`. @errors FieldInvalid for a program with errors.
Result<std::string> formatted_text(const OpenProgram& program);

/// One way to put a finding right.
struct Remedy {
  std::string title;
  std::vector<Edit> edits;
  bool is_preferred = true;
};

/// The remedies of a finding and those of its code; also a silencing comment for a warning or note.
std::vector<Remedy> remedies(const EditedText& text, const klartext::Diagnostic& found);

}  // namespace fitgauge::cli

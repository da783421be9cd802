#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/open_programs.hpp"

/// The knowledge of the language server about a place of a program, in either dialect.
namespace fitgauge::cli {

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
/// Cycles with their parameters, in a cycle the parameters that it lacks, and first words of
/// blocks.
std::vector<Completion> completions(const EditedText& text, Place cursor, bool is_iso);

/// One way to put a finding right.
struct Remedy {
  std::string title;
  Edit edit;
  bool corrects = true;  ///< else it silences
};
std::vector<Remedy> remedies(const EditedText& text, const klartext::Diagnostic& found);

/// Formats like `nc format`. @errors FieldInvalid for a program with errors.
Result<std::string> formatted_text(const OpenProgram& program);

}  // namespace fitgauge::cli

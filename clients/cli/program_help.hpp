#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cli/edited_text.hpp"
#include "nc/klartext/diagnostic.hpp"

/// What the language server knows about a place of a program, in either dialect.
namespace fitgauge::cli {

/// Markdown: the cycle of a line with its parameters, units and results; the meaning of a parameter
/// in its cycle; the lines that set one. Empty if there is nothing to say.
std::string hover_text(const EditedText& text, Place place);

struct CompletionItem {
  std::string label;
  std::string detail;
  std::string insert;       ///< a snippet of LSP
  std::size_t replace = 0;  ///< the column in the line, in bytes, where it begins
};

/// Cycles with their parameters behind what begins one, the parameters that a cycle lacks, or else
/// the words that begin blocks. @param offset that of the cursor
std::vector<CompletionItem> completions(const EditedText& text, std::size_t offset, bool is_iso);

/// A snippet without its marks: `+0` of `${1:+0}`.
std::string plain_text(std::string_view snippet);

/// One way to put a finding right.
struct Remedy {
  std::string title;
  std::size_t line = 0;
  std::string by;            ///< the line as it is then
  bool is_preferred = true;  ///< it corrects; else it silences
};
std::vector<Remedy> remedies(const EditedText& text, const klartext::Diagnostic& found);

/// A DIN/ISO program with its blocks numbered in tens and without blanks at the ends of lines.
std::string renumbered(const EditedText& text);

}  // namespace fitgauge::cli

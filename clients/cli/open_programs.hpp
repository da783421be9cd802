#pragma once

#include <filesystem>

#include "nc/program/program_cache.hpp"

namespace fitgauge::cli {

/// A place as an editor counts (LSP 3.17): lines from 0, then UTF-16 code units.
struct Place {
  std::size_t line = 0;
  std::size_t character = 0;
};

struct Edit {
  Place begin;
  Place end;
  std::string by;
};
/// Edits by URI.
using Changes = std::map<std::string, std::vector<Edit>>;

/// UTF-8 that an editor changes piece by piece; lines end with CRLF, LF or CR. Places beyond a line
/// or the text are its end. Single-threaded.
class EditedText {
 public:
  /// @param name the file's name
  EditedText(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
    find_lines();
  }

  const std::string& text() const { return text_; }
  std::size_t lines() const { return starts_.size(); }
  /// Returns a line without its line end; empty beyond the last line.
  std::string_view line(std::size_t number) const;
  /// Returns the column in bytes.
  std::size_t column(Place place) const;
  Place place(std::size_t line, std::size_t column) const;
  /// @param column in characters from 1, as a finding has it
  Place place_of_column(std::size_t line, std::size_t column) const;
  Place end() const { return place(lines() - 1, text_.size()); }
  void replace(Place begin, Place end, std::string_view by);
  bool is_iso() const;
  /// The blocks of the text; valid until it changes.
  const klartext::Program& tree() const;
  /// Returns a number that is different for each text.
  std::uint64_t revision() const { return revision_; }

 private:
  void find_lines();

  std::string text_;
  std::string name_;
  std::vector<std::size_t> starts_;
  mutable std::optional<klartext::Program> tree_;  ///< none until it is asked for
  std::uint64_t revision_ = 0;
};

/// A Q, QL, QR or QS as it is written in a line.
struct WrittenParameter {
  std::size_t begin = 0;
  std::size_t end = 0;
  klartext::QRef parameter{};
  bool is_set = false;     ///< left of `=`
  bool is_cycles = false;  ///< of a cycle: set in its block
};

/// A program as an editor has it.
struct OpenProgram {
  std::string uri;
  std::filesystem::path path;     ///< empty when no file has it
  interpreter::ControlPath name;  ///< with its folder as TNC:\.
  EditedText text;
  std::optional<std::size_t> version{};  ///< version number of the editor
  bool is_stale = true;                  ///< `found` is out of date
  std::vector<klartext::Diagnostic> found{};
};

/// The programs of an editor, and the files in their folders. Single-threaded.
class OpenPrograms {
 public:
  /// The programs by URI.
  std::map<std::string, OpenProgram>& all() { return all_; }
  OpenProgram& open(const std::string& uri, std::string text);

  /// Fills `found` with the findings of a check.
  void check(OpenProgram& program);

  /// Returns URI and line of the label or file that a line names.
  std::optional<std::pair<std::string, std::size_t>> definition(const OpenProgram& program,
                                                                std::size_t line);

  /// Renames a parameter in this program and, unless it is a QL, in all that call it or are called,
  /// masks too.
  /// @errors FieldInvalid: the new name is none, is used already or means another kind of value; or
  ///   the control, a cycle, a table or a circle sets one of both.
  Result<Changes> rename(const OpenProgram& program, const WrittenParameter& from,
                         std::string_view to);

 private:
  class Disk;
  std::vector<interpreter::ControlPath> connected(const OpenProgram& program, const Disk& disk);

  std::map<std::string, OpenProgram> all_;
  interpreter::ProgramCache cache_;
};

// The knowledge of the language server about a place of a program, in either dialect.

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

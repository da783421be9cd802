#pragma once

#include "nc/iso/codes.hpp"

namespace fitgauge::iso {

/// Whether the block goes on in the next line.
inline bool wraps(std::string_view line) { return trim(line).ends_with('~'); }

/// Physical lines: their code without the `*` that ends a block, and the comment. The code ends at
/// a line end, a `;` or a `*`, so that the lexer does not skip blanks after it.
struct Line {
  explicit Line(std::string_view text) : code(text) {
    bool quoted = false;
    for (std::size_t i = 0; i < text.size() && !has_comment; ++i) {
      if (text[i] == '"') quoted = !quoted;
      if (text[i] == '\n') quoted = false;
      has_comment = text[i] == ';' && !quoted;
      if (has_comment) code = text.substr(0, i);
    }
    if (has_comment) comment = text.substr(code.size() + 1);
    const std::string_view bare = klartext::without_wrap(code);
    is_end = bare.ends_with('*');
    if (is_end)
      code = {code.data(), static_cast<std::size_t>(bare.data() + bare.size() - 1 - code.data())};
  }

  std::string_view code;
  std::string_view comment;
  bool has_comment = false;
  bool is_end = false;
};

/// A DIN/ISO program as Klartext, and the places its lines come from.
struct Translation {
  struct Finding {
    std::size_t line = 0;  ///< of the Klartext, from 0
    klartext::DiagnosticCode code = klartext::DiagnosticCode::SyntaxError;
    klartext::Slice<char> place;  ///< in the DIN/ISO text
    std::string message;
  };

  std::string klartext;
  std::vector<klartext::Slice<char>> lines;  ///< for each line of the Klartext its place
  std::vector<Finding> unreadable;           ///< of lines that are no Klartext, in their order
  std::vector<Finding> warnings;
  std::size_t blocks = 0;
  bool is_too_large = false;  ///< the text ends early
};

/// Writes each block of a decoded text as Klartext.
Translation translate(const std::string& source);

/// Writes the Klartext lines of one block after the other.
class LineWriter {
 public:
  explicit LineWriter(Translation& out) : out_(out) {}

  /// The block of the next lines, with the part before its statements.
  void begin_block(klartext::Slice<char> place, std::string prefix);
  void start_line();
  /// A line that continues the last block.
  void continue_line(klartext::Slice<char> place);
  /// A piece of a statement; its wraps become blanks.
  LineWriter& put(std::string_view piece);
  LineWriter& put(const Word& word);
  void put_rest(BlockWords& words);
  void comment(std::string_view comment);
  bool is_written() const { return is_written_; }

  /// Makes the blocks of a pattern. @returns the fault of the words, or nothing.
  std::string pattern(std::string_view pattern, BlockWords& words, char tool_axis);

 private:
  std::string value(char key, BlockWords& words, char tool_axis);

  Translation& out_;
  klartext::Slice<char> place_;
  std::string prefix_;
  bool is_written_ = false;
};

}  // namespace fitgauge::iso

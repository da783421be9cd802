#pragma once

#include "nc/klartext/lexer.hpp"

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

/// A word as written: `X+10`; `F MAX` is the words F and MAX.
struct Word {
  std::string name;        ///< in capitals
  std::string_view value;  ///< with its sign; empty if there is none
  bool incremental = false;
  bool used = false;  ///< written as Klartext

  bool is_axis() const {
    return name.size() == 1 &&
           std::string_view("XYZABCUVW").find(name[0]) != std::string_view::npos;
  }
};

/// The state that lasts from block to block.
struct Modes {
  const Code* path = nullptr;
  std::string_view direction;  ///< of the last arc
  bool incremental = false;
  char tool_axis = 'Z';
  /// Stated since the last label or call: an earlier statement depends on the way to here.
  bool path_stated = false;
  bool dimension_stated = true;
};

/// The words of one block of G codes, M functions and coordinates.
struct BlockWords {
  std::vector<Word> words;
  std::vector<std::string_view> p;      ///< the values of P01, P02, ...
  const Code* block = nullptr;          ///< a code with a separate block
  std::array<const Code*, 3> stated{};  ///< the codes of Path, Compensation and Plane
  bool has_path = false;
  bool has_plane = false;
  std::string_view compensation;
  std::string_view text;  ///< after G39; of a D function the parameter after it

  /// The first word of that name that is not used, or nullptr.
  Word* find(std::string_view name);
  /// Without the words that belong to an M function: `M128 F1000`.
  std::span<Word> own();
  template <class Test>
  bool any(Test test) const {
    for (const Word& word : words) {
      if (!word.used && test(word)) return true;
    }
    return false;
  }
};

/// Reads the words from here to the end of the block and updates the modes; `in` fails.
BlockWords read_words(klartext::Lexer& in, Modes& modes);

/// `P01 +5 P02 X-` from here to the end of the block.
void read_p(klartext::Lexer& in, std::vector<std::string_view>& values);

/// `+10`, `-Q5`, `Q5`, `"text"`, as written; empty if none of them is next.
std::string_view read_value(klartext::Lexer& in);

/// `1`, `"NAME"`, `QS1`.
std::string_view read_label(klartext::Lexer& in);

/// Returns the first word in the title of a cycle, before its parameters, that has an effect in a
/// block: `G91`, `M5`, `X+10`.
std::string_view effective_word(std::string_view title);

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

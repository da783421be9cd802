#pragma once

#include "nc/klartext/lexer.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

/// Reads one block: the lexer's characters, and the pools for its content. Finish a list before
/// starting the next. Used by one thread.
class BlockReader : public Lexer {
 public:
  explicit BlockReader(ProgramParts& parts) : Lexer(parts.source), parts_(parts) {}

  /// Starts a block; `drop_block` removes everything that it has added to the pools.
  void open(std::size_t begin, std::size_t end);
  void drop_block();

  // --- texts
  /// Comment of the block's first line, if a cycle has read it.
  Text& block_comment() { return comment_; }
  /// Adds a text; all empty texts share one.
  Text add_text(std::string_view text);
  std::string_view text(Text text) const {
    return std::string_view(parts_.texts).substr(text.first, text.size);
  }
  /// A quoted text of at most `longest` characters.
  Text quoted_text(std::size_t longest, std::string_view what);

  // --- expressions
  Expr add_node(Operator op, std::span<const Expr> operands);
  Expr add_node(Operator op, std::initializer_list<Expr> operands) {
    return add_node(op, std::span(operands.begin(), operands.size()));
  }
  /// True for texts, QS parameters and the functions that give a text.
  bool is_string(const Expr& expr) const;
  Slice<Expr> add_operands(std::span<const Expr> operands);

  // --- words
  std::uint32_t word_count() const { return static_cast<std::uint32_t>(parts_.words.size()); }
  void add_word(const Word& word) { parts_.words.push_back(word); }
  std::span<const Word> words(Slice<Word> slice) const {
    return std::span(parts_.words).subspan(slice.first, slice.count);
  }
  /// The words added since word_count() was `first`.
  Slice<Word> words_since(std::uint32_t first) const { return {first, word_count() - first}; }

  // --- cycle parameters
  std::vector<CycleParameter>& cycle_parameters() { return parts_.cycle_parameters; }

  /// Enters a level of parentheses or functions; leave() ends it.
  void enter();
  void leave() { --depth_; }

 private:
  struct Sizes {
    std::size_t words = 0;
    std::size_t cycle_parameters = 0;
    std::size_t nodes = 0;
    std::size_t operands = 0;
    std::size_t texts = 0;
  };

  ProgramParts& parts_;
  Sizes at_open_;
  Text comment_;
  int depth_ = 0;
};

inline constexpr LetterSet kAxes(Letter::X, Letter::Y, Letter::Z, Letter::A, Letter::B, Letter::C,
                                 Letter::U, Letter::V, Letter::W);
/// `F` with all its forms.
inline constexpr LetterSet kFeeds(Letter::F, Letter::FMax, Letter::FAuto, Letter::Fu, Letter::Fz,
                                  Letter::Ft, Letter::FMaxT);

/// Words that may count from the end of the last block: `IX+5`.
inline constexpr LetterSet kIncremental = kAxes | LetterSet(Letter::Pr, Letter::Pa, Letter::Rot);

/// The words of a positioning block.
LetterSet words_of(Path path);
/// The words that define a plane.
LetterSet words_of(PlaneKind kind);

/// Reads words of one block into the Program's pool, one at a time.
class WordReader {
 public:
  /// @param allowed words of this block.
  /// @param bare words without a value: the axes of `CYCL DEF 8.1 X Y`.
  /// @param incremental words with I, which the run reads.
  WordReader(BlockReader& in, LetterSet allowed, LetterSet bare = LetterSet(),
             LetterSet incremental = kIncremental);

  /// Reads the next word, or several; fails if one is not allowed or is repeated.
  void read();
  Slice<Word> words() const { return in_.words_since(first_); }

 private:
  bool read_plain_words();
  Word parse_name();
  void parse_value_of(Word& word);
  void parse_m_number(Word& word);

  BlockReader& in_;
  LetterSet allowed_;
  LetterSet bare_;
  LetterSet incremental_;
  LetterSet seen_;
  LetterSet plain_;      ///< remaining letters that may be read the short way
  LetterSet arguments_;  ///< of the M function read last
  bool arguments_are_bare_ = false;
  std::uint32_t first_;
};

/// All words up to the end of the block.
Slice<Word> parse_words(BlockReader& in, LetterSet allowed, LetterSet bare = LetterSet(),
                        LetterSet incremental = kIncremental);

/// Whether words that follow this M function belong to it, as F of `M128 F1000`.
bool has_arguments(unsigned m);

}  // namespace fitgauge::klartext

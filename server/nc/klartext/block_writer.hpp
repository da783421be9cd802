#pragma once

#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

/// Writes the parts of statements as Klartext; the mirror of BlockReader. Appends to a text of its
/// caller; calls that return the writer can be chained. Single-threaded.
class BlockWriter {
 public:
  BlockWriter(const Program& program, std::string& out) : program_(program), out_(out) {}

  BlockWriter& write(std::string_view text) { return out_ += text, *this; }
  BlockWriter& write(Text text) { return write(program_.text(text)); }
  void quoted(Text text);
  void number(double number);
  BlockWriter& parameter(QRef parameter);
  /// Writes a sign before a number: `+10`, `-Q5`; texts and QS parameters have no sign.
  BlockWriter& signed_value(const Expr& expr);
  /// Writes like signed_value(), without `+`.
  BlockWriter& value(const Expr& expr);
  /// A formula with the parentheses it needs.
  void formula(const Expr& expr);
  /// Writes a file name, without quotes if that reads back the same.
  void path(const Expr& expr);
  void label(const Label& label);
  /// Items separated by `/`.
  void items(Slice<Expr> items);

  void word(const Word& word);
  /// Writes words, each after a blank unless it begins the block. `mark` comes before the first
  /// word of `before`, or at the end.
  void words(Slice<Word> words, std::string_view mark = {}, LetterSet before = LetterSet());

  const Program& program() const { return program_; }

 private:
  /// Binding strength of an expression; the levels of the parser's grammar.
  enum class Level { Concat, Sum, Product, Power, Signed, Alone };

  Level level_of(const Expr& expr) const;
  void expression(const Expr& expr, Level least);
  void node(NodeIndex index);
  void string_function(const Node& node);
  void path_piece(const Expr& piece);

  const Program& program_;
  std::string& out_;
};

}  // namespace fitgauge::klartext

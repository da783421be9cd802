#pragma once

#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"

/// The plain forms of Klartext, each described once: the parser reads a statement along its form()
/// and the printer writes it along the same one. `io` is a FormReader or a FormWriter.
namespace fitgauge::klartext {

/// Reads the members of a form, after its first words.
class FormReader {
 public:
  explicit FormReader(BlockReader& in) : in_(in) {}

  /// The first words, which identify the form.
  FormReader& head(std::string_view) { return *this; }
  FormReader& fn(unsigned) { return *this; }
  FormReader& word(std::string_view word) { return in_.expect_word(word), *this; }
  FormReader& mark(char c) { return in_.expect(c), *this; }
  /// A mark that may be left out.
  FormReader& maybe(char c) { return in_.accept(c), *this; }
  /// Reads like maybe(); the writer joins it to the next text.
  FormReader& joined(char c) { return maybe(c); }
  /// One of two words, joined to what follows.
  FormReader& either(bool& is_first, std::string_view first, std::string_view second) {
    is_first = in_.accept_prefix(first);
    if (!is_first) in_.expect_prefix(second);
    return *this;
  }
  FormReader& number(Expr& value) { return value = parse_number(in_), *this; }
  /// Reads like number(); the writer prints its sign.
  FormReader& signed_number(Expr& value) { return number(value); }
  /// A path that ends before `stop`.
  FormReader& path(Expr& path, char stop = ';') { return path = parse_path(in_, stop), *this; }
  FormReader& parameter(QRef& parameter) { return parameter = in_.parameter(), *this; }
  /// The parameter of a number.
  FormReader& target(QRef& target) { return target = parse_target(in_), *this; }
  FormReader& items(Slice<Expr>& items) { return items = parse_items(in_), *this; }
  FormReader& cell(Expr& cell) { return cell = parse_cell(in_), *this; }
  FormReader& address(Expr& address) {
    return address = parse_system_address(in_, Operator::SystemAddress), *this;
  }
  FormReader& label(Label& label) { return label = parse_label(in_), *this; }
  FormReader& repeat(Expr& count) {
    if (in_.accept_prefix("REP")) count = parse_repeat(in_);
    return *this;
  }
  FormReader& words(Slice<Word>& words, LetterSet allowed) {
    return words = parse_words(in_, allowed), *this;
  }
  /// All up to the end of the block.
  FormReader& rest(Text& text) { return text = in_.add_text(free_text(in_.rest())), *this; }

 private:
  BlockReader& in_;
};

void form(auto& io, Stop& stop) { io.head("STOP").words(stop.words, LetterSet(Letter::M)); }
void form(auto& io, LabelDefinition& definition) { io.head("LBL").label(definition.label); }
void form(auto& io, LabelCall& call) { io.head("CALL LBL").label(call.label).repeat(call.repeat); }
void form(auto& io, CallProgram& call) { io.head("CALL PGM").path(call.path); }
void form(auto& io, CallSelectedProgram&) { io.head("CALL SELECTED PGM"); }
void form(auto& io, SelectProgram& select) { io.head("SEL PGM").path(select.path); }
void form(auto& io, SelectTable& select) { io.head("SEL TABLE").path(select.path); }
void form(auto& io, Dwell& dwell) {
  io.head("FUNCTION DWELL").either(dwell.revolutions, "REV", "TIME").number(dwell.value);
}
void form(auto& io, ErrorStop& stop) { io.fn(14).word("ERROR").maybe('=').number(stop.number); }
void form(auto& io, Print& print) { io.fn(15).word("PRINT").items(print.items); }
void form(auto& io, FormattedPrint& print) {
  io.fn(16).word("F-PRINT").path(print.mask, '/').mark('/').path(print.target);
}
void form(auto& io, SystemWrite& write) {
  io.fn(17).word("SYSWRITE").address(write.address).mark('=').signed_number(write.value);
}
/// FN 19, 29, 37 and 38; the parser sets the number.
void form(auto& io, ExternalFunction& function) {
  io.fn(function.fn);
  switch (function.fn) {
    case 37: io.word("EXPORT"); break;
    case 38: io.word("SEND").joined('/'); break;
    default: io.word("PLC").mark('=');
  }
  io.items(function.operands);
}
void form(auto& io, WaitFor& wait) { io.fn(20).word("WAIT").word("FOR").rest(wait.condition); }
/// FN 23 and 24; the parser sets how many points.
void form(auto& io, CircleData& circle) {
  io.fn(20U + circle.points).target(circle.target).mark('=').word("CDATA");
  io.target(circle.first_point);
}
void form(auto& io, TableOpen& open) { io.fn(26).word("TABOPEN").path(open.path); }
void form(auto& io, TableWrite& write) {
  io.fn(27).word("TABWRITE").cell(write.cell).mark('=').parameter(write.first);
}
void form(auto& io, TableRead& read) {
  io.fn(28).word("TABREAD").parameter(read.first).mark('=').cell(read.cell);
}

template <class S>
Statement read_form(BlockReader& in, S statement = {}) {
  FormReader io(in);
  form(io, statement);
  return statement;
}

}  // namespace fitgauge::klartext

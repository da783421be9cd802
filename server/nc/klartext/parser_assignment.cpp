#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

Statement parse_formula_of(BlockReader& in, QRef target, AssignmentForm form) {
  in.expect('=');
  in.skip_blanks();
  const char* begin = in.at();
  const Expr value = parse_formula(in);
  if (!in.failure() && in.is_string(value) != target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            target.is_string() ? "a QS parameter takes a text: TOCHAR makes one of a number"
                               : "this parameter takes a number: TONUMB makes one of a text");
  }
  return Assignment{.target = target, .form = form, .fn = 0, .value = value};
}

}  // namespace

Statement parse_assignment(BlockReader& in) {
  const QRef target = in.parameter();
  return parse_formula_of(in, target, AssignmentForm::Formula);
}

Statement parse_declare(BlockReader& in) {
  if (!in.accept_word("STRING")) {
    refuse_word(in, "DECLARE");
    return Empty{};
  }
  in.skip_blanks();
  const char* begin = in.at();
  const QRef target = in.parameter();
  if (!in.failure() && !target.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            "DECLARE STRING takes a QS parameter");
  }
  return parse_formula_of(in, target, AssignmentForm::DeclareString);
}

}  // namespace fitgauge::klartext

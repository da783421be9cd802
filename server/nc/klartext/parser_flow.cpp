#include "base/text.hpp"
#include "nc/klartext/forms.hpp"
#include "nc/klartext/operator_names.hpp"

namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kLargestLabel = 65534;
constexpr std::size_t kLongestLabelName = 32;

constexpr std::string_view kParameterMark = ":'";

/// Reads `QSn` and the characters behind it that must follow; the lexer is moved there.
Expr parse_embedded_parameter(BlockReader& in, const char* at, std::string_view close) {
  in.move_to(at);
  const char* begin = in.at();
  const QRef parameter = in.parameter();
  if (!in.failure() && !parameter.is_string()) {
    in.fail(DiagnosticCode::ParameterType, in.place(begin, in.at()),
            "a file name must come from a QS parameter");
  }
  for (const char c : close) in.expect(c);
  return parameter;
}

/// The pieces of a bare path between `at` and `end`, joined.
Expr parse_path_pieces(BlockReader& in, const char* at, const char* end) {
  Expr path;
  const auto join = [&](const Expr& piece) {
    path = is_absent(path) ? piece : in.add_node(Operator::Concat, {path, piece});
  };
  while (at != end && !in.failure()) {
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    const std::size_t mark = std::min(rest.find(kParameterMark), rest.size());
    if (mark > 0) join(in.add_text(unwrapped(rest.substr(0, mark))));
    at += mark;
    if (at == end) break;
    join(parse_embedded_parameter(in, at + kParameterMark.size(), "'"));
    at = in.at();
  }
  if (!in.failure()) in.move_to(end);
  return path;
}

}  // namespace

Expr parse_path(BlockReader& in, char stop) {
  in.skip_blanks();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the file name");
  const std::string_view bare = in.rest_until(stop);
  if (bare.empty()) {
    in.fail_expected("a file name");
    return Absent{};
  }
  const bool invalid = std::any_of(bare.begin(), bare.end(), [](char c) {
    return c == '"' || (static_cast<unsigned char>(c) < 0x20 && c != '\n');
  });
  if (invalid || bare.size() > kLongestString) {
    in.fail(DiagnosticCode::SyntaxError, in.place(bare.data(), bare.data() + bare.size()),
            "the file name is too long or has a character that is not allowed");
    return Absent{};
  }
  const bool is_parameter = ascii_iequals(bare.substr(0, 2), "QS") && bare.size() > 2 &&
                            std::all_of(bare.begin() + 2, bare.end(), is_digit);
  if (is_parameter) return parse_embedded_parameter(in, bare.data(), "");
  return parse_path_pieces(in, bare.data(), bare.data() + bare.size());
}

Label parse_label(BlockReader& in) {
  in.skip_blanks();
  if (in.at_number()) return in.digits(kLargestLabel, "the label");
  if (in.at_parameter()) return in.parameter();
  if (in.peek() != '"') {
    in.fail_expected("a label: a number, a name in double quotes or a parameter");
    return Label{};
  }
  const char* begin = in.at();
  const Text name = in.quoted_text(kLongestLabelName, "the name of the label");
  if (name.empty()) {
    in.fail(DiagnosticCode::LabelMalformed, in.place(begin, in.at()),
            "the name of the label is empty");
  }
  return name;
}

Expr parse_repeat(BlockReader& in) {
  const Expr repeat = parse_number(in);
  if (!in.accept('/')) return repeat;
  in.skip_blanks();
  if (in.at_parameter()) {
    in.parameter();
  } else {
    in.digits(kLargestLabel, "the count after '/'");
  }
  return repeat;
}

Statement parse_label_definition(BlockReader& in) {
  in.skip_blanks();
  const char* begin = in.at();
  const Label label = parse_label(in);
  if (std::holds_alternative<QRef>(label)) {
    in.fail(DiagnosticCode::LabelMalformed, in.place(begin, in.at()),
            "a label is defined by a number or a name, not by a parameter");
  }
  return LabelDefinition{label};
}

Statement parse_call(BlockReader& in) {
  if (in.accept_prefix("LBL")) return read_form<LabelCall>(in);
  if (in.accept_word("PGM")) return read_form<CallProgram>(in);
  if (in.accept_word("SELECTED")) {
    if (in.accept_word("PGM")) return CallSelectedProgram{};
    return refuse_word(in, "CALL SELECTED");
  }
  return refuse_word(in, "CALL");
}

Statement parse_select(BlockReader& in) {
  if (in.accept_word("PGM")) return read_form<SelectProgram>(in);
  if (in.accept_word("TABLE")) return read_form<SelectTable>(in);
  return refuse_word(in, "SEL");
}

}  // namespace fitgauge::klartext

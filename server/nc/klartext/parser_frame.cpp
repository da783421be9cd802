#include "base/text.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"

namespace fitgauge::klartext {
namespace {

/// `name MM`: the unit is the last word, the name may hold blanks.
template <class Frame>
Statement parse_frame(BlockReader& in) {
  in.expect_word("PGM");
  const char* begin = in.at();
  const std::string text = free_text(in.rest());
  const std::string_view rest = trim(text);
  const std::size_t blank = rest.find_last_of(" \t");
  const std::size_t unit_at = blank == std::string_view::npos ? 0 : blank + 1;
  const std::string_view unit = rest.substr(unit_at);
  const bool inch = ascii_iequals(unit, "INCH");
  if (!inch && !ascii_iequals(unit, "MM")) {
    in.fail(DiagnosticCode::SyntaxError, in.place(begin, in.at()),
            "expected the name of the program and its unit, MM or INCH");
  }
  const Text name = in.add_text(trim(rest.substr(0, unit_at)));
  return Frame{name, inch ? Unit::Inch : Unit::Millimetre};
}

/// A letter of an axis alone, as in `BLK FORM 0.1 Z X+0`.
std::optional<Axis> parse_tool_axis(BlockReader& in) {
  const std::string_view name = in.letters();
  const std::optional<Letter> letter = name.size() == 1 ? find_letter(name) : std::nullopt;
  if (!letter || !is_axis(*letter)) {
    in.fail_expected("the tool axis");
    return std::nullopt;
  }
  in.move_to(in.at() + 1);
  return axis_of(*letter);
}

constexpr LetterSet kCylinder(Letter::R, Letter::D, Letter::L, Letter::Dist, Letter::Ri,
                              Letter::Di);

Slice<Word> parse_rotation(BlockReader& in) {
  const std::uint32_t first = in.word_count();
  if (in.accept_word("DIM_R")) {
    in.add_word({.letter = Letter::DimR});
  } else if (in.accept_word("DIM_D")) {
    in.add_word({.letter = Letter::DimD});
  }
  in.expect_prefix("LBL");
  const Label label = parse_label(in);
  const auto value_of = [](const auto& value) -> Expr {
    if constexpr (std::is_integral_v<std::decay_t<decltype(value)>>) {
      return static_cast<double>(value);
    } else {
      return value;
    }
  };
  in.add_word({.value = std::visit(value_of, label), .letter = Letter::Label});
  return in.words_since(first);
}

BlankForm parse_file_blank(BlockReader& in) {
  BlankForm form{.kind = BlankKind::File};
  form.file = parse_string(in);
  const std::uint32_t first = in.word_count();
  if (in.accept_word("TARGET")) in.add_word({.value = parse_string(in), .letter = Letter::Target});
  form.words = in.words_since(first);
  return form;
}

}  // namespace

Statement parse_begin(BlockReader& in) { return parse_frame<BeginProgram>(in); }

Statement parse_end(BlockReader& in) { return parse_frame<EndProgram>(in); }

Statement parse_blank_form(BlockReader& in) {
  in.expect_word("FORM");
  if (in.accept_word("FILE")) return parse_file_blank(in);
  BlankForm form;
  if (in.accept_word("0.2")) {
    form.kind = BlankKind::Maximum;
    form.words = parse_words(in, kAxes);
    return form;
  }
  if (in.accept_word("CYLINDER")) {
    form.kind = BlankKind::Cylinder;
  } else if (in.accept_word("ROTATION")) {
    form.kind = BlankKind::Rotation;
  } else {
    in.expect_word("0.1");
  }
  form.tool_axis = parse_tool_axis(in);
  form.words = form.kind == BlankKind::Rotation   ? parse_rotation(in)
               : form.kind == BlankKind::Cylinder ? parse_words(in, kCylinder)
                                                  : parse_words(in, kAxes);
  return form;
}

Statement parse_structure(BlockReader& in) {
  const char* begin = in.at();
  in.skip_blanks();
  const auto indent = std::max<std::ptrdiff_t>(in.at() - begin, 1);
  if (!in.accept('-')) return Structure{in.add_text(free_text(in.rest())), 0};
  // `* - `, `*   - `, `*     - `: two more blanks for each level.
  constexpr std::ptrdiff_t kDeepest = 100;
  const auto level = static_cast<std::uint8_t>(std::min((indent - 1) / 2, kDeepest));
  return Structure{in.add_text(free_text(in.rest())), level};
}

}  // namespace fitgauge::klartext

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

template <class Frame>
Statement parse_frame(BlockReader& in) {
  in.expect_word("PGM");
  return read_form<Frame>(in);
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

Statement parse_blank_form(BlockReader& in) {
  in.expect_word("FORM");
  const auto kind = accept_name<BlankKind>(in, kBlankKinds);
  if (!kind) return in.fail_expected("0.1");
  BlankForm form{.kind = *kind};
  if (*kind == BlankKind::File) {
    form.file = parse_string(in);
    const std::uint32_t first = in.word_count();
    if (in.accept_word("TARGET"))
      in.add_word({.value = parse_string(in), .letter = Letter::Target});
    form.words = in.words_since(first);
    return form;
  }
  if (*kind != BlankKind::Maximum) {
    form.tool_axis = parse_axis_alone(in);
    if (!form.tool_axis) in.fail_expected("the tool axis");
  }
  form.words = *kind == BlankKind::Rotation   ? parse_rotation(in)
               : *kind == BlankKind::Cylinder ? parse_words(in, kCylinder)
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

struct Keyword {
  std::string_view name;
  Statement (*parse)(BlockReader& in);
};

template <Path path>
Statement motion(BlockReader& in) {
  return parse_motion(in, path);
}

/// The first words of blocks, the most frequent ones first.
constexpr Keyword kBlockKeywords[] = {
    {"L", motion<Path::L>},
    {"FN", parse_fn},
    {"C", motion<Path::C>},
    {"CC", motion<Path::Cc>},
    {"LBL", parse_label_definition},
    {"CALL", parse_call},
    {"TCH", parse_tch_probe},
    {"CYCL", parse_cycl},
    {"TOOL", parse_tool},
    {"M", parse_m_functions},
    {"STOP", [](BlockReader& in) { return read_form<Stop>(in); }},
    {"LP", motion<Path::Lp>},
    {"LN", motion<Path::Ln>},
    {"CP", motion<Path::Cp>},
    {"CR", motion<Path::Cr>},
    {"CT", motion<Path::Ct>},
    {"CTP", motion<Path::Ctp>},
    {"RND", motion<Path::Rnd>},
    {"CHF", motion<Path::Chf>},
    {"APPR", parse_approach},
    {"DEP", parse_departure},
    {"SEL", parse_select},
    {"TRANS", parse_trans},
    {"PLANE", parse_plane},
    {"FUNCTION", parse_function},
    {"PATTERN", parse_pattern},
    {"DECLARE", parse_declare},
    {"GLOBAL", parse_global},
    {"BLK", parse_blank_form},
    {"BEGIN", parse_frame<BeginProgram>},
    {"END", parse_frame<EndProgram>},
};

// The features that real controls run and this one does not, by the first words of their blocks.
constexpr std::string_view kContourWords[] = {"FL", "FLT", "FC", "FCT", "FPOL", "FSELECT"};
constexpr std::string_view kFeatures[] = {"SQL",        "CONTOUR DEF", "PRESET",
                                          "TABDATA",    "POLARKIN",    "SECTION MONITORING",
                                          "MONITORING", "OPEN",        "WMAT"};

std::string_view first_word(std::string_view feature) {
  return feature.substr(0, feature.find(' '));
}

Statement parse_error_block(BlockReader& in) {
  in.expect('=');
  const char* begin = in.skip_blanks();
  in.move_to(in.end());
  const std::string_view raw(begin, in.end());
  return ErrorBlock{in.add_text(free_text(raw))};
}

/// `X+46 R+ F1000`, `Z0.0 B0.0`; the block begins with a word of an axis.
bool at_paraxial_block(std::string_view name) {
  const std::size_t letter = name.size() == 2 && ascii_upper(name.front()) == 'I' ? 1 : 0;
  if (name.size() != letter + 1) return false;
  const std::optional<Letter> found = find_letter(name.substr(letter));
  return found && is_axis(*found);
}

/// `C+45`: the axis; in the arc `C X+5 Y+5` the words follow a blank.
bool at_c_axis(BlockReader& in, std::string_view name) {
  return ascii_iequals(name, "C") &&
         (in.peek() == '+' || in.peek() == '-' || in.at_number() || in.at_parameter());
}

/// CYCL for CYCLE. A word that few blocks have in second place tells the first.
SpellingHint similar_keyword(std::string_view name, std::string_view next) {
  struct Second {
    std::string_view word;
    std::array<std::string_view, 4> first;
  };
  constexpr Second kSeconds[] = {{"DEF", {"CYCL", "TOOL", "GLOBAL", "PATTERN"}},
                                 {"CALL", {"CYCL", "TOOL"}},
                                 {"PROBE", {"TCH"}},
                                 {"PGM", {"CALL", "SEL", "BEGIN", "END"}}};
  SpellingHint hint(name);
  const auto* second = std::ranges::find_if(
      kSeconds, [next](const Second& each) { return ascii_iequals(each.word, next); });
  if (second != std::end(kSeconds)) {
    for (const std::string_view first : second->first) hint.consider(first);
    return hint;
  }
  for (const Keyword& keyword : kBlockKeywords) hint.consider(keyword.name);
  return hint;
}

}  // namespace

Statement refuse_word(BlockReader& in, std::string_view first) {
  const std::string_view word = in.letters();
  if (word.empty()) return in.fail_expected(fmt::format("a word behind {}", first));
  const char* begin = in.at();
  in.move_to(begin + word.size());
  return in.refuse(begin, fmt::format("{} {}", first, excerpt(ascii_upper(word))));
}

std::vector<std::string_view> block_keywords() {
  std::vector<std::string_view> words{"ERROR"};
  for (const Keyword& keyword : kBlockKeywords) words.push_back(keyword.name);
  words.insert(words.end(), std::begin(kContourWords), std::end(kContourWords));
  for (const std::string_view feature : kFeatures) words.push_back(first_word(feature));
  return words;
}

Statement parse_statement(BlockReader& in) {
  if (in.at_parameter()) return parse_assignment(in);
  const char* begin = in.at();
  const std::string_view name = in.letters();
  in.move_to(begin + name.size());
  if (at_c_axis(in, name)) {
    in.move_to(begin);
    return parse_motion(in, Path::Paraxial);
  }
  for (const Keyword& keyword : kBlockKeywords) {
    if (ascii_iequals(keyword.name, name)) return keyword.parse(in);
  }
  if (ascii_iequals(name, "ERROR")) return parse_error_block(in);
  for (const std::string_view word : kContourWords) {
    if (ascii_iequals(word, name)) return in.refuse(begin, "FK contour programming");
  }
  for (const std::string_view feature : kFeatures) {
    if (ascii_iequals(first_word(feature), name)) return in.refuse(begin, feature);
  }
  in.move_to(begin);
  if (at_paraxial_block(name)) return parse_motion(in, Path::Paraxial);
  if (in.accept('*')) return parse_structure(in);
  if (name.empty()) return in.fail_expected("a block");
  in.move_to(begin + name.size());
  in.skip_blanks();
  const SpellingHint hint = similar_keyword(name, in.letters());
  return in.fail(DiagnosticCode::BlockUnknown, in.place(begin, begin + name.size()),
                 fmt::format("no block begins with '{}'{}", excerpt(name), hint.text()),
                 hint.word());
}

void parse_frame(BlockReader& in, Text& name, Unit& unit_of) {
  const char* begin = in.at();
  const std::string text = free_text(in.rest());
  const std::string_view rest = trim(text);
  const std::size_t blank = rest.find_last_of(" \t");
  const std::size_t unit_at = blank == std::string_view::npos ? 0 : blank + 1;
  const std::string_view unit = rest.substr(unit_at);
  const bool inch = ascii_iequals(unit, "INCH");
  if (!inch && !ascii_iequals(unit, "MM")) {
    in.fail(DiagnosticCode::SyntaxError, in.since(begin),
            "expected the name of the program and its unit, MM or INCH");
  }
  name = in.add_text(trim(rest.substr(0, unit_at)));
  unit_of = inch ? Unit::Inch : Unit::Millimetre;
}

}  // namespace fitgauge::klartext

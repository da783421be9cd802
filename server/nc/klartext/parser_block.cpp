#include "base/text.hpp"
#include "nc/klartext/forms.hpp"
#include "nc/klartext/parser.hpp"

namespace fitgauge::klartext {
namespace {

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
    {"BEGIN", parse_begin},
    {"END", parse_end},
};

/// The first words of blocks that real controls run and this one does not.
struct Feature {
  std::string_view name;
  std::string_view feature;
};

constexpr Feature kFeatures[] = {
    {"FL", "FK contour programming"},
    {"FLT", "FK contour programming"},
    {"FC", "FK contour programming"},
    {"FCT", "FK contour programming"},
    {"FPOL", "FK contour programming"},
    {"FSELECT", "FK contour programming"},
    {"SQL", "SQL"},
    {"CONTOUR", "CONTOUR DEF"},
    {"PRESET", "PRESET"},
    {"TABDATA", "TABDATA"},
    {"POLARKIN", "POLARKIN"},
    {"SECTION", "SECTION MONITORING"},
    {"MONITORING", "MONITORING"},
    {"OPEN", "OPEN"},
    {"WMAT", "WMAT"},
};

Statement parse_error_block(BlockReader& in) {
  in.expect('=');
  in.skip_blanks();
  const char* begin = in.at();
  in.move_to(in.end());
  const std::string_view raw(begin, static_cast<std::size_t>(in.end() - begin));
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

Statement expected(BlockReader& in, std::string_view what) {
  in.fail_expected(what);
  return Empty{};
}

Statement refuse_word(BlockReader& in, std::string_view first) {
  const std::string_view word = in.letters();
  if (word.empty()) return expected(in, fmt::format("a word behind {}", first));
  const char* begin = in.at();
  in.move_to(begin + word.size());
  in.refuse(begin, fmt::format("{} {}", first, excerpt(ascii_upper(word))));
  return Empty{};
}

std::vector<std::string_view> block_keywords() {
  std::vector<std::string_view> words{"ERROR"};
  for (const Keyword& keyword : kBlockKeywords) words.push_back(keyword.name);
  for (const Feature& feature : kFeatures) words.push_back(feature.name);
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
  for (const Feature& feature : kFeatures) {
    if (ascii_iequals(feature.name, name)) {
      in.refuse(begin, feature.feature);
      return Empty{};
    }
  }
  in.move_to(begin);
  if (at_paraxial_block(name)) return parse_motion(in, Path::Paraxial);
  if (in.accept('*')) return parse_structure(in);
  if (name.empty()) {
    in.fail_expected("a block");
  } else {
    in.move_to(begin + name.size());
    in.skip_blanks();
    const SpellingHint hint = similar_keyword(name, in.letters());
    in.fail(DiagnosticCode::BlockUnknown, in.place(begin, begin + name.size()),
            fmt::format("no block begins with '{}'{}", excerpt(name), hint.text()), hint.word());
  }
  return Empty{};
}

}  // namespace fitgauge::klartext

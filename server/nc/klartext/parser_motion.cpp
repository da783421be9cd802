#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

/// After the R, in the order of RadiusCompensation from R0.
constexpr std::string_view kCompensationLetters = "0LR+-";

/// `R0`, `RL`, `RR`, `R+`, `R-` if no letter or digit follows; `R0.5` and `R+20` are radii.
/// @param has_radius the block may have a radius R, so `R+ 20` is a radius.
bool parse_compensation(BlockReader& in, Motion& motion, bool has_radius) {
  const char c = ascii_upper(in.peek(1));
  const char behind = in.peek(2);
  const std::size_t found = kCompensationLetters.find(c);
  if (found == kCompensationLetters.npos || is_ascii_letter(behind) || is_digit(behind) ||
      behind == '.' || behind == ',' || (has_radius && (c == '+' || c == '-'))) {
    return false;
  }
  if (motion.compensation != RadiusCompensation::Unchanged) {
    in.fail(DiagnosticCode::WordRepeated, in.place(in.at(), in.at() + 2),
            "the radius compensation is repeated in this block");
    return true;
  }
  motion.compensation = static_cast<RadiusCompensation>(found + 1);
  in.move_to(in.at() + 2);
  return true;
}

/// `DR+`, `DR-`.
bool parse_rotation(BlockReader& in, Motion& motion) {
  const char sign = in.peek(2);
  if (ascii_upper(in.peek(1)) != 'R' || (sign != '+' && sign != '-')) return false;
  if (motion.rotation != Rotation::Unspecified) {
    in.fail(DiagnosticCode::WordRepeated, in.place(in.at(), in.at() + 3),
            "the direction of rotation is repeated in this block");
    return true;
  }
  motion.rotation = sign == '+' ? Rotation::Positive : Rotation::Negative;
  in.move_to(in.at() + 3);
  return true;
}

/// Reads the letter of a word without value: `R`, `F` and `M` of the TNC 151 to 415, which list
/// each word of a block even if nothing was entered (`L X+5 R F M`).
bool parse_blank_word(BlockReader& in) {
  const char* begin = in.at();
  if (in.at_end()) return false;
  const char behind = in.peek(1);
  if (behind != '\0' && !is_blank(behind) && behind != ';' && behind != '~') return false;
  in.move_to(begin + 1);
  in.skip_blanks();
  const char next = in.peek();
  const bool has_value = next == '+' || next == '-' || in.at_number() || in.at_parameter() ||
                         in.accept_word("MAX") || in.accept_word("AUTO");
  if (has_value) in.move_to(begin);
  return !has_value;
}

Statement parse_second_word(BlockReader& in, std::string_view first) {
  in.skip_blanks();
  const std::string_view second = in.letters();
  for (std::size_t i = 0; i < std::size(kPaths); ++i) {
    const std::string_view name = kPaths[i];
    if (name.size() == first.size() + 1 + second.size() && name.starts_with(first) &&
        ascii_iequals(name.substr(first.size() + 1), second)) {
      in.move_to(in.at() + second.size());
      return parse_motion(in, static_cast<Path>(i));
    }
  }
  return in.fail_expected(first == "DEP" ? "LT, LN, CT, LCT or PLCT"
                                         : "LT, LN, CT, LCT, PLT, PLN, PCT or PLCT");
}

constexpr std::uint32_t kMostElements = 99;
constexpr LetterSet kPoint(Letter::X, Letter::Y, Letter::Z);
constexpr LetterSet kGrid = kPoint | LetterSet(Letter::Dx, Letter::Dy, Letter::NumX, Letter::NumY,
                                               Letter::Rot, Letter::RotX, Letter::RotY);

/// The words of each element, in the order of PatternElement.
constexpr LetterSet kElementWords[] = {
    kPoint,
    kPoint | LetterSet(Letter::D, Letter::Num, Letter::Rot),
    kGrid,
    kGrid,
    kPoint | LetterSet(Letter::D, Letter::Start, Letter::Num),
    kPoint | LetterSet(Letter::D, Letter::Start, Letter::Step, Letter::Num),
};
static_assert(std::size(kElementWords) == std::size(kPatternElements));

void parse_element(BlockReader& in) {
  const std::string_view name = in.letters();
  std::size_t kind = 0;
  while (kind < std::size(kPatternElements) && !ascii_iequals(kPatternElements[kind], name)) ++kind;
  if (kind == std::size(kPatternElements)) {
    in.fail_expected("POS, ROW, PAT, FRAME, CIRC or PITCHCIRC");
    return;
  }
  in.move_to(in.at() + name.size());
  const std::uint32_t number = in.digits(kMostElements, "the number of the element");
  in.add_word({.value = static_cast<double>(kind), .letter = Letter::Element});
  in.add_word({.value = static_cast<double>(number), .letter = Letter::Value});
  in.skip_blanks();
  in.expect('(');
  WordReader words(in, kElementWords[kind], LetterSet(), kPoint);
  while (!in.at_end() && in.peek() != ')') words.read();
  in.expect(')');
}

}  // namespace

LetterSet words_of(Path path) {
  constexpr LetterSet kM(Letter::M);
  constexpr LetterSet kEveryMotion = kAxes | kFeeds | kM;
  constexpr LetterSet kPolar(Letter::Pr, Letter::Pa);
  constexpr LetterSet kWords[] = {
#define FITGAUGE_PATH(path, spelling, words) words,
#include "nc/klartext/paths.inc"
#undef FITGAUGE_PATH
  };
  return kWords[static_cast<std::size_t>(path)];
}

Statement parse_motion(BlockReader& in, Path path) {
  Motion motion{.path = path};
  const LetterSet allowed = words_of(path);
  WordReader words(in, allowed);
  if (path == Path::Chf && !in.at_end())
    in.add_word({.value = parse_number(in), .letter = Letter::Chamfer});
  const bool turns = path == Path::C || path == Path::Cp || path == Path::Cr || path == Path::Ct ||
                     path == Path::Ctp;
  const bool compensates = path != Path::Cc && path != Path::Rnd && path != Path::Chf;
  while (!in.at_end()) {
    const char c = ascii_upper(in.peek());
    if ((c == 'R' || c == 'F' || c == 'M') && parse_blank_word(in)) continue;
    if (c == 'R' && compensates && parse_compensation(in, motion, allowed.contains(Letter::R)))
      continue;
    if (c == 'D' && turns && parse_rotation(in, motion)) continue;
    words.read();
  }
  motion.words = words.words();
  return motion;
}

Statement parse_approach(BlockReader& in) { return parse_second_word(in, "APPR"); }

Statement parse_departure(BlockReader& in) { return parse_second_word(in, "DEP"); }

Statement parse_m_functions(BlockReader& in) {
  in.move_to(in.at() - 1);  // the M that was read as the first word
  return MFunctions{parse_words(in, LetterSet(Letter::M))};
}

Statement parse_pattern(BlockReader& in) {
  in.expect_word("DEF");
  const std::uint32_t first = in.word_count();
  while (!in.at_end()) parse_element(in);
  PatternDefinition pattern{in.words_since(first)};
  if (pattern.words.count == 0) in.fail_expected("POS, ROW, PAT, FRAME, CIRC or PITCHCIRC");
  return pattern;
}

Statement parse_tool(BlockReader& in) {
  if (in.accept_joined("CALL")) return read_form<ToolCall>(in);
  if (in.accept_joined("DEF")) return read_form<ToolDefinition>(in);
  return in.fail_expected("CALL or DEF");
}

Expr parse_tool_name(BlockReader& in) {
  in.skip_blanks();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the name of the tool");
  if (in.at_number()) return in.number();
  if (in.at_parameter()) return in.parameter();
  return Absent{};
}

std::optional<Axis> parse_axis_alone(BlockReader& in) {
  const std::string_view name = in.letters();
  if (name.size() != 1) return std::nullopt;
  const std::optional<Letter> letter = find_letter(name);
  if (!letter || !is_axis(*letter)) return std::nullopt;
  in.move_to(in.at() + 1);
  return axis_of(*letter);
}

}  // namespace fitgauge::klartext

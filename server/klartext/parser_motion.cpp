#include "base/text.hpp"
#include "klartext/parser_rules.hpp"
#include "klartext/parser_words.hpp"
#include "klartext/path_names.hpp"

namespace fitgauge::klartext {
namespace {

constexpr LetterSet kM(Letter::M);
constexpr LetterSet kEveryMotion = kAxes | kFeeds | kM;
constexpr LetterSet kPolar(Letter::Pr, Letter::Pa);

/// The words of each path, in the order of Path.
constexpr LetterSet kWordsOf[] = {
    kEveryMotion,           // L
    kEveryMotion | kPolar,  // LP
    kEveryMotion | LetterSet(Letter::Nx, Letter::Ny, Letter::Nz, Letter::Tx, Letter::Ty,
                             Letter::Tz),                       // LN
    kAxes,                                                      // CC
    kEveryMotion,                                               // C
    kEveryMotion | kPolar,                                      // CP
    kEveryMotion | LetterSet(Letter::R),                        // CR
    kEveryMotion,                                               // CT
    kEveryMotion | kPolar,                                      // CTP
    LetterSet(Letter::R) | kFeeds | kM,                         // RND
    LetterSet(Letter::Chamfer) | kFeeds | kM,                   // CHF
    kEveryMotion | LetterSet(Letter::Len),                      // APPR LT
    kEveryMotion | LetterSet(Letter::Len),                      // APPR LN
    kEveryMotion | LetterSet(Letter::Cca, Letter::R),           // APPR CT
    kEveryMotion | LetterSet(Letter::R),                        // APPR LCT
    kEveryMotion | kPolar | LetterSet(Letter::Len),             // APPR PLT
    kEveryMotion | kPolar | LetterSet(Letter::Len),             // APPR PLN
    kEveryMotion | kPolar | LetterSet(Letter::Cca, Letter::R),  // APPR PCT
    kEveryMotion | kPolar | LetterSet(Letter::R),               // APPR PLCT
    kFeeds | kM | LetterSet(Letter::Len),                       // DEP LT
    kFeeds | kM | LetterSet(Letter::Len),                       // DEP LN
    kFeeds | kM | LetterSet(Letter::Cca, Letter::R),            // DEP CT
    kEveryMotion | LetterSet(Letter::R),                        // DEP LCT
    kEveryMotion | kPolar | LetterSet(Letter::R),               // DEP PLCT
};
static_assert(std::size(kWordsOf) == std::size(kPaths));

/// `R0`, `RL`, `RR` without a letter or digit behind it; `R0.5` is a radius.
bool parse_compensation(BlockReader& in, Motion& motion) {
  const char c = ascii_upper(in.peek(1));
  const char behind = in.peek(2);
  if ((c != '0' && c != 'L' && c != 'R') || is_ascii_letter(behind) || is_digit(behind) ||
      behind == '.' || behind == ',') {
    return false;
  }
  const auto compensation = c == '0'   ? RadiusCompensation::R0
                            : c == 'L' ? RadiusCompensation::Rl
                                       : RadiusCompensation::Rr;
  if (motion.compensation != RadiusCompensation::Unchanged) {
    in.fail(DiagnosticCode::WordRepeated, in.place(in.at(), in.at() + 2),
            "the radius compensation stands twice in this block");
    return true;
  }
  motion.compensation = compensation;
  in.move_to(in.at() + 2);
  return true;
}

/// `DR+`, `DR-`.
bool parse_rotation(BlockReader& in, Motion& motion) {
  const char sign = in.peek(2);
  if (ascii_upper(in.peek(1)) != 'R' || (sign != '+' && sign != '-')) return false;
  if (motion.rotation != Rotation::Unspecified) {
    in.fail(DiagnosticCode::WordRepeated, in.place(in.at(), in.at() + 3),
            "the direction of rotation stands twice in this block");
    return true;
  }
  motion.rotation = sign == '+' ? Rotation::Positive : Rotation::Negative;
  in.move_to(in.at() + 3);
  return true;
}

Statement parse_second_word(BlockReader& in, std::string_view first) {
  in.skip_blanks();
  const std::string_view second = in.letters();
  for (const PathName& row : kPaths) {
    if (row.name.size() == first.size() + 1 + second.size() && row.name.starts_with(first) &&
        ascii_iequals(row.name.substr(first.size() + 1), second)) {
      in.move_to(in.at() + second.size());
      return parse_motion(in, row.path);
    }
  }
  in.fail_expected(first == "DEP" ? "LT, LN, CT, LCT or PLCT"
                                  : "LT, LN, CT, LCT, PLT, PLN, PCT or PLCT");
  return Empty{};
}

}  // namespace

Statement parse_motion(BlockReader& in, Path path) {
  Motion motion{.path = path};
  WordReader words(in, kWordsOf[static_cast<std::size_t>(path)]);
  if (path == Path::Chf && !in.at_end()) {
    in.add_word({.letter = Letter::Chamfer, .value = parse_number(in)});
  }
  const bool turns = path == Path::C || path == Path::Cp || path == Path::Cr || path == Path::Ct ||
                     path == Path::Ctp;
  const bool compensates = path != Path::Cc && path != Path::Rnd && path != Path::Chf;
  while (!in.at_end()) {
    const char c = ascii_upper(in.peek());
    if (c == 'R' && compensates && parse_compensation(in, motion)) continue;
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
  return MFunctions{parse_words(in, kM)};
}

Statement parse_stop(BlockReader& in) { return Stop{parse_words(in, kM)}; }

}  // namespace fitgauge::klartext

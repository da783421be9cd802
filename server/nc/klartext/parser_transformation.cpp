#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

constexpr LetterSet kEveryPlane =
    kFeeds | LetterSet(Letter::Mb, Letter::MbMax, Letter::Dist, Letter::Seq, Letter::Sym);

bool parse_positioning(BlockReader& in, Plane& plane) {
  const auto found = accept_name<PlanePositioning>(in, kPlanePositionings);
  if (!found) return false;
  if (plane.positioning != PlanePositioning::Unspecified) {
    in.fail(DiagnosticCode::WordRepeated, in.here(),
            "TURN, MOVE and STAY exclude each other: name one of them");
  }
  plane.positioning = *found;
  return true;
}

/// `SEQ+`, `SYM-`, `TABLE ROT`, `COORD ROT`.
bool parse_solution(BlockReader& in) {
  for (const Letter letter : {Letter::TableRot, Letter::CoordRot}) {
    const std::string_view name = spelling(letter);
    if (in.accept_word(name.substr(0, name.find(' ')))) {
      in.expect_word("ROT");
      in.add_word({.letter = letter});
      return true;
    }
  }
  for (const Letter letter : {Letter::Seq, Letter::Sym}) {
    if (in.accept_word(spelling(letter))) {
      const bool minus = in.accept('-');
      if (!minus) in.expect('+');
      in.add_word({.value = minus ? -1.0 : 1.0, .letter = letter});
      return true;
    }
  }
  return false;
}

/// One word of these at most.
void check_exclusive(BlockReader& in, Slice<Word> words, LetterSet letters,
                     std::string_view names) {
  const auto found = in.words(words);
  if (std::ranges::count_if(found,
                            [&](const Word& word) { return letters.contains(word.letter); }) < 2)
    return;
  in.fail(DiagnosticCode::WordRepeated, in.here(),
          fmt::format("{} exclude each other: name one of them", names));
}

Statement parse_plane_kind(BlockReader& in, PlaneKind kind) {
  Plane plane{.kind = kind};
  WordReader words(in, kEveryPlane | words_of(kind), LetterSet(), LetterSet());
  while (!in.at_end()) {
    if (!parse_positioning(in, plane) && !parse_solution(in)) words.read();
  }
  plane.words = words.words();
  check_exclusive(in, plane.words, LetterSet(Letter::Seq, Letter::Sym), "SEQ and SYM");
  check_exclusive(in, plane.words, LetterSet(Letter::TableRot, Letter::CoordRot),
                  "TABLE ROT and COORD ROT");
  if (kind == PlaneKind::Relativ)
    check_exclusive(in, plane.words, words_of(kind), "SPA, SPB and SPC of RELATIV");
  return plane;
}

Statement parse_trans_datum(BlockReader& in) {
  Trans trans{.kind = Transformation::Datum};
  if (in.accept_word("RESET")) {
    trans.reset = true;
  } else if (in.accept_word("TABLE")) {
    trans.kind = Transformation::DatumTable;
    in.skip_blanks();
    if (in.peek() == '"' || in.at_parameter()) trans.table = parse_string(in);
    trans.words = parse_words(in, LetterSet(Letter::Row));
  } else {
    in.expect_word("AXIS");
    trans.words = parse_words(in, kAxes);
  }
  return trans;
}

/// Words or `RESET`.
Statement parse_trans_words(BlockReader& in, Transformation kind, LetterSet words,
                            LetterSet bare = LetterSet()) {
  Trans trans{.kind = kind};
  trans.reset = in.accept_word("RESET");
  if (!trans.reset) {
    if (kind == Transformation::Mirror) in.expect_word("AXIS");
    trans.words = parse_words(in, words, bare);
    if (trans.words.count == 0) in.fail_expected("a word or RESET");
  }
  return trans;
}

Statement parse_mode(BlockReader& in) {
  const char* begin = in.skip_blanks();
  for (const std::string_view other : {"TURN", "GRIND"})
    if (in.accept_word(other)) return in.refuse(begin, fmt::format("FUNCTION MODE {}", other));
  if (!in.accept_word("MILL")) return in.fail_expected("MILL, TURN or GRIND");
  FunctionMode mode;
  in.skip_blanks();
  if (in.peek() == '"') mode.kinematics = in.quoted_text(255, "the name of the kinematics");
  return mode;
}

/// Options of FUNCTION TCPM, each once, and their words.
constexpr struct {
  std::string_view name;
  std::array<std::string_view, 3> words;
} kTcpmOptions[] = {{"F", {"TCP", "CONT", "CONT"}},
                    {"AXIS", {"POS", "SPAT", "SPAT"}},
                    {"PATHCTRL", {"AXIS", "VECTOR", "VECTOR"}},
                    {"REFPNT", {"TIP-TIP", "TIP-CENTER", "CENTER-CENTER"}}};

std::string next_word(BlockReader& in) {
  const char* begin = in.skip_blanks();
  in.move_to(std::find_if(begin, in.end(), [](char c) { return is_blank(c) || c == ';'; }));
  return ascii_upper(std::string_view(begin, static_cast<std::size_t>(in.at() - begin)));
}

/// `F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP F5000`, kept with one blank between words.
Statement parse_tcpm(BlockReader& in) {
  std::string options;
  std::array<bool, std::size(kTcpmOptions)> given{};
  while (!in.at_end() && !in.failure()) {
    const char* begin = in.at();
    std::string written = next_word(in);
    const auto* option = std::ranges::find(kTcpmOptions, std::string_view(written),
                                           [](const auto& o) { return o.name; });
    // F with a number limits the feed of the linear axes.
    bool is_known =
        written.size() > 1 && written.front() == 'F' &&
        (written == "FMAX" || std::all_of(written.begin() + 1, written.end(), is_digit));
    if (option != std::end(kTcpmOptions)) {
      const std::string value = next_word(in);
      bool& before = given[static_cast<std::size_t>(option - kTcpmOptions)];
      is_known = !before && std::ranges::count(option->words, value) > 0;
      before = true;
      written += ' ' + value;
    }
    if (!is_known) {
      in.fail(DiagnosticCode::SyntaxError, in.since(begin),
              "FUNCTION TCPM takes, each once: F TCP or CONT, AXIS POS or SPAT, PATHCTRL AXIS or "
              "VECTOR, REFPNT TIP-TIP, TIP-CENTER or CENTER-CENTER, and F with a number");
    }
    options += (options.empty() ? "" : " ") + written;
  }
  return FunctionTcpm{.active = true, .options = in.add_text(options)};
}

}  // namespace

LetterSet words_of(PlaneKind kind) {
  constexpr LetterSet kPlaneWords[] = {
      LetterSet(Letter::Spa, Letter::Spb, Letter::Spc),
      LetterSet(Letter::ProPr, Letter::ProMin, Letter::Rot),
      LetterSet(Letter::EulPr, Letter::EulNu, Letter::EulRot),
      LetterSet(Letter::Bx, Letter::By, Letter::Bz, Letter::Nx, Letter::Ny, Letter::Nz),
      LetterSet(Letter::P1x, Letter::P1y, Letter::P1z, Letter::P2x, Letter::P2y, Letter::P2z,
                Letter::P3x, Letter::P3y, Letter::P3z),
      LetterSet(Letter::Spa, Letter::Spb, Letter::Spc),
      LetterSet(Letter::A, Letter::B, Letter::C),
      LetterSet(),
  };
  static_assert(std::size(kPlaneWords) == std::size(kPlaneKinds));
  return kPlaneWords[static_cast<std::size_t>(kind)];
}

Statement parse_trans(BlockReader& in) {
  if (in.accept_word("DATUM")) return parse_trans_datum(in);
  if (in.accept_word("MIRROR")) return parse_trans_words(in, Transformation::Mirror, kAxes, kAxes);
  if (in.accept_word("ROTATION"))
    return parse_trans_words(in, Transformation::Rotation, LetterSet(Letter::Rot));
  if (in.accept_word("SCALE"))
    return parse_trans_words(in, Transformation::Scale, LetterSet(Letter::Scl));
  return in.fail_expected("DATUM, MIRROR, ROTATION or SCALE");
}

Statement parse_plane(BlockReader& in) {
  if (const auto kind = accept_name<PlaneKind>(in, kPlaneKinds)) return parse_plane_kind(in, *kind);
  return in.fail_expected("SPATIAL, PROJECTED, EULER, VECTOR, POINTS, RELATIV, AXIAL or RESET");
}

Statement parse_function(BlockReader& in) {
  if (in.accept_word("MODE")) return parse_mode(in);
  if (in.accept_word("TCPM")) return parse_tcpm(in);
  if (in.accept_word("DWELL")) return read_form<Dwell>(in);
  if (in.accept_word("RESET")) {
    if (in.accept_word("TCPM")) return FunctionTcpm{.active = false};
    return refuse_word(in, "FUNCTION RESET");
  }
  return refuse_word(in, "FUNCTION");
}

}  // namespace fitgauge::klartext

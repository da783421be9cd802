#include "nc/klartext/word_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/text.hpp"

namespace fitgauge::klartext {
namespace {

struct Row {
  Letter letter;
  std::string_view name;
};

/// In the order of Letter.
constexpr Row kRows[] = {
    {Letter::X, "X"},
    {Letter::Y, "Y"},
    {Letter::Z, "Z"},
    {Letter::A, "A"},
    {Letter::B, "B"},
    {Letter::C, "C"},
    {Letter::U, "U"},
    {Letter::V, "V"},
    {Letter::W, "W"},
    {Letter::Nx, "NX"},
    {Letter::Ny, "NY"},
    {Letter::Nz, "NZ"},
    {Letter::Tx, "TX"},
    {Letter::Ty, "TY"},
    {Letter::Tz, "TZ"},
    {Letter::Bx, "BX"},
    {Letter::By, "BY"},
    {Letter::Bz, "BZ"},
    {Letter::Pr, "PR"},
    {Letter::Pa, "PA"},
    {Letter::R, "R"},
    {Letter::Len, "LEN"},
    {Letter::Cca, "CCA"},
    {Letter::Chamfer, ""},
    {Letter::F, "F"},
    {Letter::FMax, "FMAX"},
    {Letter::FAuto, "FAUTO"},
    {Letter::Fu, "FU"},
    {Letter::Fz, "FZ"},
    {Letter::Ft, "FT"},
    {Letter::FMaxT, "FMAXT"},
    {Letter::S, "S"},
    {Letter::Dl, "DL"},
    {Letter::Dr, "DR"},
    {Letter::Dr2, "DR2"},
    {Letter::L, "L"},
    {Letter::M, "M"},
    {Letter::Mb, "MB"},
    {Letter::MbMax, "MB MAX"},
    {Letter::La, "LA"},
    {Letter::T, "T"},
    {Letter::D, "D"},
    {Letter::Dist, "DIST"},
    {Letter::Ri, "RI"},
    {Letter::Label, "LBL "},
    {Letter::DimR, "DIM_R"},
    {Letter::DimD, "DIM_D"},
    {Letter::Target, "TARGET "},
    {Letter::Rot, "ROT"},
    {Letter::Scl, "SCL"},
    {Letter::Ccx, "CCX"},
    {Letter::Ccy, "CCY"},
    {Letter::Ccz, "CCZ"},
    {Letter::Ta, "TA"},
    {Letter::HscMode, "HSC-MODE"},
    {Letter::Row, "TABLINE"},
    {Letter::Program, "PGM"},
    {Letter::Result, ""},
    {Letter::Value, ""},
    {Letter::Spa, "SPA"},
    {Letter::Spb, "SPB"},
    {Letter::Spc, "SPC"},
    {Letter::ProPr, "PROPR"},
    {Letter::ProMin, "PROMIN"},
    {Letter::EulPr, "EULPR"},
    {Letter::EulNu, "EULNU"},
    {Letter::EulRot, "EULROT"},
    {Letter::P1x, "P1X"},
    {Letter::P1y, "P1Y"},
    {Letter::P1z, "P1Z"},
    {Letter::P2x, "P2X"},
    {Letter::P2y, "P2Y"},
    {Letter::P2z, "P2Z"},
    {Letter::P3x, "P3X"},
    {Letter::P3y, "P3Y"},
    {Letter::P3z, "P3Z"},
    {Letter::Seq, "SEQ"},
    {Letter::Sym, "SYM"},
    {Letter::TableRot, "TABLE ROT"},
    {Letter::CoordRot, "COORD ROT"},
    {Letter::Element, ""},
    {Letter::Num, "NUM"},
    {Letter::NumX, "NUMX"},
    {Letter::NumY, "NUMY"},
    {Letter::Dx, "DX"},
    {Letter::Dy, "DY"},
    {Letter::RotX, "ROTX"},
    {Letter::RotY, "ROTY"},
    {Letter::Start, "START"},
    {Letter::Step, "STEP"},
};

constexpr bool rows_follow_letters() {
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    if (static_cast<std::size_t>(kRows[i].letter) != i) return false;
  }
  return true;
}
static_assert(rows_follow_letters());
static_assert(std::size(kRows) <= 128, "LetterSet holds 128 letters");

/// The rows of names that begin with each character, so that a look-up compares few.
constexpr std::array<Letter, 26> kFirstRow = [] {
  std::array<Letter, 26> first{};
  first.fill(static_cast<Letter>(std::size(kRows)));
  for (std::size_t i = std::size(kRows); i > 0; --i) {
    const Row& row = kRows[i - 1];
    if (!row.name.empty()) first[static_cast<std::size_t>(row.name[0] - 'A')] = row.letter;
  }
  return first;
}();

}  // namespace

constinit const std::array<Letter, 26> kSingleLetters = [] {
  std::array<Letter, 26> singles{};
  singles.fill(Letter::Value);
  for (const Row& row : kRows) {
    if (row.name.size() == 1) singles[static_cast<std::size_t>(row.name[0] - 'A')] = row.letter;
  }
  return singles;
}();

std::optional<Letter> find_letter(std::string_view letters) {
  if (letters.empty()) return std::nullopt;
  if (letters.size() == 1) {
    const Letter letter = single_letter(letters.front());
    return letter == Letter::Value ? std::nullopt : std::optional(letter);
  }
  const auto initial = static_cast<std::size_t>(ascii_upper(letters.front()) - 'A');
  for (auto i = static_cast<std::size_t>(kFirstRow[initial]); i < std::size(kRows); ++i) {
    if (ascii_iequals(kRows[i].name, letters)) return kRows[i].letter;
  }
  return std::nullopt;
}

std::string_view spelling(Letter letter) { return kRows[static_cast<std::size_t>(letter)].name; }

bool is_bare(Letter letter) {
  constexpr LetterSet kBare(Letter::FMax, Letter::FAuto, Letter::FMaxT, Letter::MbMax, Letter::DimR,
                            Letter::DimD, Letter::TableRot, Letter::CoordRot);
  return kBare.contains(letter);
}

}  // namespace fitgauge::klartext

#include "nc/iso/codes.hpp"

#include "nc/klartext/operator_names.hpp"

namespace fitgauge::iso {
namespace {

using enum CodeKind;

/// In the order of their numbers.
constexpr Code kCodes[] = {
    {0, Path, "L", "FMAX"},
    {1, Path, "L"},
    {2, Path, "C", "DR-"},
    {3, Path, "C", "DR+"},
    {4, Block, "CYCL DEF 9.0 DWELL TIME|CYCL DEF 9.1 DWELL $F"},
    {5, Path, "C", "DR"},
    {6, Path, "CT"},
    {7, Path, ""},
    {10, Path, "LP", "FMAX"},
    {11, Path, "LP"},
    {12, Path, "CP", "DR-"},
    {13, Path, "CP", "DR+"},
    {15, Path, "CP", "DR"},
    {16, Path, "CTP"},
    {17, Plane, "Z"},
    {18, Plane, "Y"},
    {19, Plane, "X"},
    {20, Absent, "use G17, G18 or G19 for the tool axis"},
    {24, Block, "CHF $R$w"},
    {25, Block, "RND R$R$w"},
    {26, Block, ""},
    {27, Block, ""},
    {28, Block, "CYCL DEF 8.0 MIRROR IMAGE|CYCL DEF 8.1$w"},
    {29, Block, "CC"},
    {30, Block, "BLK FORM 0.1 $a$w"},
    {31, Block, "BLK FORM 0.2$w"},
    {36, Block, "CYCL DEF 13.0 ORIENTATION|CYCL DEF 13.1 ANGLE $S"},
    {37, Block, "CYCL DEF 14.0 CONTOUR GEOMETRY|CYCL DEF 14.1 CONTOUR LABEL $p"},
    {38, Block, "STOP$w"},
    {39, Block, "CYCL DEF 12.0 PGM CALL|CYCL DEF 12.1 PGM $t"},
    {40, Compensation, "R0"},
    {41, Compensation, "RL"},
    {42, Compensation, "RR"},
    {43, Compensation, "R+"},
    {44, Compensation, "R-"},
    {50, Absent, "leave it out: it protects a file"},
    {51, Block, "TOOL DEF $T"},
    {53, Block, "CYCL DEF 7.0 DATUM SHIFT|CYCL DEF 7.1 #$1"},
    {54, Block, "CYCL DEF 7.0 DATUM SHIFT|CYCL DEF 7.1$w"},
    {55, Block, "TCH PROBE 0.0 REF. PLANE $r $2|TCH PROBE 0.1 $3"},
    {56, Absent, "use cycle G121"},
    {57, Absent, "use cycle G122"},
    {58, Absent, "use cycle G125, or G124 for finishing"},
    {59, Absent, "use cycle G125, or G124 for finishing"},
    {62, Block, "CYCL DEF 32.0 TOLERANCE|CYCL DEF 32.1$w"},
    {70, Absent, "the unit of the program stands in its first line"},
    {71, Absent, "the unit of the program stands in its first line"},
    {72, Block, "CYCL DEF 11.0 SCALING|CYCL DEF 11.1 SCL$F"},
    {73, Block, "CYCL DEF 10.0 ROTATION|CYCL DEF 10.1$w"},
    {74, Absent, "use cycle G253"},
    {75, Absent, "use cycle G251"},
    {76, Absent, "use cycle G251"},
    {77, Absent, "use cycle G252"},
    {78, Absent, "use cycle G252"},
    {79, Block, "CYCL CALL$w"},
    {80, Block, "CYCL DEF 19.0 WORKING PLANE|CYCL DEF 19.1$w"},
    {83, Absent, "use cycle G200"},
    {84, Absent, "use cycle G206"},
    {85, Absent, "use cycle G207"},
    {86, Absent, "use one of the cycles G262 to G267"},
    {90, Dimension, ""},
    {91, Dimension, "I"},
    {98, Block, "LBL $L"},
    {99, Block, "TOOL DEF $T$w"},
};

struct Function {
  unsigned number;
  std::string_view pattern;
};

constexpr Function kFunctions[] = {
    {0, "$q = $1"},     {14, "ERROR = $1"},  {15, "PRINT $p"},      {16, "F-PRINT $p"},
    {19, "PLC = $p"},   {20, "WAIT FOR $1"}, {23, "$q = CDATA $1"}, {24, "$q = CDATA $1"},
    {26, "TABOPEN $1"}, {29, "PLC = $p"},    {37, "EXPORT $p"},     {38, "SEND /$p"},
};

constexpr unsigned kFirstContourCycle = 120;
constexpr unsigned kLastContourCycle = 128;
constexpr unsigned kFirstCycle = 200;

constexpr Code kAnyCycle{0, Cycle, {}};

}  // namespace

const Code* find_code(unsigned number) {
  const bool is_contour = number >= kFirstContourCycle && number <= kLastContourCycle;
  if (is_contour || number >= kFirstCycle) return &kAnyCycle;
  const auto* found = std::ranges::find(kCodes, number, &Code::number);
  return found != std::end(kCodes) ? found : nullptr;
}

std::span<const Code> codes() { return kCodes; }

std::string function_pattern(unsigned number) {
  constexpr unsigned kFirstComparison = 9;
  if (const auto* row = klartext::find_arithmetic(number)) {
    return fmt::format("$q = {} {} {}", row->unary ? "" : "$1", row->sign,
                       row->unary ? "$1" : "$2");
  }
  if (number - kFirstComparison < std::size(klartext::kComparisons)) {
    return fmt::format("IF $1 {} $2 GOTO LBL $3",
                       klartext::kComparisons[number - kFirstComparison].name);
  }
  const auto* row = std::ranges::find(kFunctions, number, &Function::number);
  return row != std::end(kFunctions) ? std::string(row->pattern) : std::string();
}

CycleHead cycle_head(unsigned code) {
  if (code < kFirstCycle) return {"CYCL DEF", code - (kFirstContourCycle - 20)};
  const bool probes = (code >= 400 && code < 500) || (code >= 1400 && code < 1500);
  return {probes ? "TCH PROBE" : "CYCL DEF", code};
}

}  // namespace fitgauge::iso

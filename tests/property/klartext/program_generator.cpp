#include "program_generator.hpp"

namespace fitgauge::klartext {
namespace {

/// A grammar: each `{name}` is replaced by one of its alternatives. Where replacements nest deeply,
/// the first alternative is taken, which leads nowhere further.
const std::map<std::string, std::vector<std::string>, std::less<>>& rules() {
  static const std::map<std::string, std::vector<std::string>, std::less<>> kRules = {
      {"line",
       {"{skip}{number}{body}{comment}\n", "{skip}{number}{body}{comment}\n",
        "{skip}{number}{body}{comment}\n", "{skip}{number}{cycleblock}{dialog}\n"}},
      {"skip", {"", "", "", "/", "/ "}},
      {"number", {"", "{digits} ", "{digits}   "}},
      {"comment", {"", "", " ;", ";{text}", " ; {text}", " ;{text}~\n{text}"}},
      {"text", {"DRILLING", "a  b", "Q5=+3", "\xC3\x84\xC3\xB6 \xE2\x82\xAC", "x ~ y", "\"", ""}},
      {"digits", {"0", "7", "12", "483", "99999"}},
      {"literal",
       {"1", "0", "2.5", "10.", ".25", "0,125", "0.333333333333333333", "999999999.999",
        "123456.789", "00012"}},
      {"sign", {"+", "-", "", "+ ", "- "}},
      {"q", {"Q5", "Q0", "Q1999", "QL3", "QR12", "q107"}},
      {"qs", {"QS1", "QS1999", "qs12"}},
      {"value", {"{sign}{literal}", "{sign}{q}"}},
      {"string", {"\"\"", "\"text\"", "\"a;b ~ \xC3\x84\"", "{qs}"}},
      {"name", {"\"NAME\"", "\"UP 1\"", "\"\xC3\x9C\""}},
      {"label", {"5", "65534", "{name}"}},
      {"target", {"{label}", "{qs}", "Q7"}},
      {"path",
       {"82551", "TNC:\\nc\\a.h", "a b.h", "\"TNC:\\a;b/c.h\"", "{qs}", ":'QS4'", "TNC:\\:'QS4'.H",
        ":'QS4':'QS5'"}},
      {"maskpath", {"82552.a", "TNC:\\nc\\a.a", "\"a/b.a\"", ":'QS4'", "TNC:\\:'QS4'.A"}},
      // formulas
      {"formula",
       {"{literal}", "{literal}", "{q}", "-{q}", "PI", "{formula} {op} {formula}", "( {formula} )",
        "-( {formula} )", "{function} {formula1}", "{textvalue}"}},
      {"formula1", {"{literal}", "-{literal}", "{q}", "( {formula} )", "{function} {formula1}"}},
      {"op", {"+", "-", "*", "/", "%", "^"}},
      {"function",
       {"SQ", "SQRT", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "LN", "LOG", "EXP", "NEG", "ABS",
        "INT", "FRAC", "SGN", "sin"}},
      {"textvalue",
       {"STRLEN( SRC_{qs} )", "TONUMB( SRC_{string} )", "INSTR( SRC_{qs} SEA_{string} BEG2 )",
        "INSTR( SRC_{qs} SEA_{qs} )", "STRCOMP( SRC_{qs} SEA_{string} )"}},
      {"concat",
       {"{string}", "{concat} || {concat}", "( {concat} )", "TOCHAR( DAT{value} DECIMALS4 )",
        "TOCHAR(DAT+Q50)", "SUBSTR( SRC_{string} BEG{digits} LENQ5 )", "SYSSTR( ID10950 NR1 )"}},
      // words
      {"x", {"", " X{value}", " IX{value}"}},
      {"y", {"", " Y{value}", " iy{value}"}},
      {"z", {"", " Z{value}", " IZ{value}"}},
      {"abc", {"", "", " A{value}", " C{value} B{value}"}},
      {"axes", {"{x}{y}{z}{abc}"}},
      {"comp", {"", " R0", " RL", " RR"}},
      {"turn", {"", " DR+", " DR-"}},
      {"feed", {"", " FMAX", " F MAX", " F{digits}", " FQ5", " F AUTO", " FU0.2", " FZ{q}"}},
      {"m",
       {"", "", " M3", " M8 M13", " M99", " M140 MB MAX", " M140 MB50 F750", " M128 F1000",
        " M118 X0.5 Y1", " M138 A C"}},
      {"end", {"{comp}{feed}{m}"}},
      {"polar", {"", " PR{value}", " IPA{value}", " PR{value} PA{value}"}},
      {"radius", {"5", "-2.5", "+Q5", "- Q5"}},
      {"datum", {"", " X Y", " X", " Z"}},
      {"parameter",
       {"Q{digits3}={value}", "Q{digits3} = FMAX", "Q{digits3}=MAX", "Q{digits3}=AUTO",
        "Q{digits3}=PREDEF", "Q{digits3}=FU0.2", "Q{digits3}=FZ{literal}", "Q{digits3}=\"NAME\"",
        "Q{digits3}={qs}"}},
      {"digits3", {"200", "273", "330"}},
      {"dialog", {"", " ;SET-UP CLEARANCE", ";{text}", " ; x ;y"}},
      {"cycle", {"CYCL DEF {digits2}", "TCH PROBE {digits2}", "tch probe 421"}},
      {"digits2", {"200", "247", "421", "4000"}},
      {"cycleblock",
       {"{cycle}{title}{dialog}~\n {parameter}{dialog}~\nQS400={string}{dialog}",
        "{cycle}{title}~\n{parameter} {qs}={value}{dialog}",
        "{cycle}{title}\n  {parameter}{dialog}", "{cycle}{title}"}},
      {"title", {"", " MEASURE HOLE", " BOHRUNG \xC3\x84", " "}},
      {"plane",
       {"SPATIAL SPA{value} SPB{value} SPC{value}",
        "PROJECTED PROPR{value} PROMIN{value} ROT{value}",
        "EULER EULPR{value} EULNU{value} EULROT{value}",
        "VECTOR BX{value} BY{value} BZ{value} NX{value} NY{value} NZ{value}",
        "POINTS P1X{value} P1Y{value} P1Z{value} P2X{value} P2Y{value} P2Z{value}",
        "RELATIV SPB{value}", "AXIAL A{value} B{value}", "RESET"}},
      {"positioning",
       {"", " STAY", " MOVE DIST50 F1000", " TURN MB MAX FMAX SEQ-", " TURN FMAX SYM+ TABLE ROT",
        " STAY COORD ROT"}},
      {"body",
       {"",
        "L{axes}{end}",
        "LP{polar}{z}{end}",
        "LN{axes} NX{value} NY{value} NZ{value}{feed}",
        "CC{x}{y}",
        "C{x}{y}{turn}{end}",
        "CP{polar}{z}{turn}{end}",
        "CR{x}{y} R{radius}{turn}{end}",
        "CT{x}{y}{end}",
        "CTP{polar}{end}",
        "RND R{value}{feed}",
        "CHF {value}",
        "APPR LT{x}{y} LEN15 RL{feed}",
        "APPR CT{x}{y} CCA180 R{radius}{comp}",
        "APPR PLCT{polar} R7 RR",
        "DEP LCT{x}{y} R{radius}{feed}",
        "DEP LT LEN{value}",
        "M30",
        "M3 M8",
        "M140 MB MAX",
        "STOP{m}",
        "TOOL CALL {digits} Z S{digits}{feed} DL{value} DR{value} DR2+0.1",
        "TOOL CALL {name} Y",
        "TOOL CALL {qs}",
        "TOOL CALL S{digits}",
        "TOOL DEF 5",
        "TOOL DEF 1 L{value} R{value}",
        "BLK FORM 0.1 Z{x}{y}{z}",
        "BLK FORM 0.2{x}{y}{z}",
        "BLK FORM CYLINDER Z R50 L{value} DIST+5",
        "BLK FORM ROTATION Z DIM_D LBL {label}",
        "BLK FORM FILE {string} TARGET {string}",
        "LBL {label}",
        "LBL 0",
        "CALL LBL {target}",
        "CALL LBL {target} REP {digits}",
        "CALL LBL {target} REP{q}",
        "CALL LBL 3 REP 2/2",
        "CALL PGM {path}",
        "SEL PGM {path}",
        "SEL TABLE {path}",
        "CALL SELECTED PGM",
        "{q} = {formula}",
        "{q}={formula}",
        "{qs} = {concat}",
        "DECLARE STRING {qs} = {string}",
        "FN 0: {q} = {value}",
        "FN0 : {q} ={value}",
        "FN 0: {q} SET UNDEFINED",
        "FN 1: {q} = {value} + {value}",
        "FN 2: {q} = {value} - {value}",
        "FN 3: {q} = {value} * {value}",
        "FN 4: {q} = {value} DIV {value}",
        "FN 5: {q} = SQRT {value}",
        "FN 6: {q} = SIN {value}",
        "FN 7: {q} = COS {value}",
        "FN 8: {q} = {value} LEN {value}",
        "FN 13: {q} = {value} ANG {value}",
        "FN 9: IF {value} EQU {value} GOTO LBL {target}",
        "FN 9: IF {q} IS UNDEFINED GOTO LBL {target}",
        "FN 9: IF {string} EQU {qs} GOTO LBL {target}",
        "FN 10: IF {value} NE {value} GOTO LBL {target}",
        "FN 11: IF {value} GT {value} GOTO LBL {target}",
        "FN 12: IF {value} LT {value} GOTO LBL {target}",
        "FN 14: ERROR = {digits}",
        "FN 15: PRINT {value}/{string}/{value}",
        "FN 16: F-PRINT {maskpath} / {path}",
        "FN 16: F-PRINT {maskpath}/SCREEN:",
        "FN 17: SYSWRITE ID 50 NR4 IDX{q} = {value}",
        "FN 18: SYSREAD {q} = ID{digits} NR{value} IDX1",
        "FN 18: SYSREAD {q} = ID20 NR1",
        "FN 19: PLC = {value}/{value}",
        "FN 20: WAIT FOR SYNC",
        "FN 23: {q} = CDATA {q}",
        "FN 24: {q} = CDATA {q}",
        "FN 26: TABOPEN {path}",
        "FN 27: TABWRITE {value}/{string} = {q}",
        "FN 28: TABREAD {qs} = {value}/:'QS1'",
        "FN 29: PLC={value}",
        "FN 37: EXPORT {qs}",
        "FN 38: SEND /{string}/{value}",
        "CYCL DEF 7.0 DATUM SHIFT",
        "CYCL DEF 7.1{x}{y}",
        "CYCL DEF 7.1 #{digits}",
        "CYCL DEF 8.1{datum}",
        "CYCL DEF 9.1 V.ZEIT {literal}",
        "CYCL DEF 10.1 ROT{value}",
        "CYCL DEF 11.1 SCL {value}",
        "CYCL DEF 12.1 PGM {path}",
        "CYCL DEF 26.1 X{value} CCX{value}",
        "CYCL DEF 32.1 T0.05",
        "TCH PROBE 0.0 REF. PLANE {q} X-",
        "TCH PROBE 3.3 ABST {value} F100 MB1 REFERENCE SYSTEM: 0",
        "CYCL CALL{m}",
        "CYCL CALL PAT{feed}{m}",
        "CYCL CALL POS{x}{y}{z}{feed}",
        "TRANS DATUM AXIS{x}{y}",
        "TRANS DATUM RESET",
        "TRANS DATUM TABLE {string} TABLINE{digits}",
        "TRANS MIRROR AXIS X Y",
        "TRANS ROTATION ROT{value}",
        "TRANS SCALE SCL{value}",
        "PLANE {plane}{positioning}",
        "FUNCTION MODE MILL \"AC\"",
        "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
        "FUNCTION RESET TCPM",
        "* - {text}",
        "*     - {text}",
        "ERROR = {text}",
        "FL X{value} IY{value}",
        "SQL {text}"}},
  };
  return kRules;
}

constexpr int kDeepest = 12;

}  // namespace

void ProgramGenerator::expand(std::string& out, std::string_view text, int depth) {
  while (!text.empty()) {
    const std::size_t open = text.find('{');
    out += text.substr(0, open);
    if (open == std::string_view::npos) return;
    const std::size_t close = text.find('}', open);
    const auto rule = rules().find(text.substr(open + 1, close - open - 1));
    if (rule == rules().end()) throw std::logic_error("no rule " + std::string(text));
    const auto& alternatives = rule->second;
    expand(out, alternatives[depth > kDeepest ? 0 : below(alternatives.size())], depth + 1);
    text.remove_prefix(close + 1);
  }
}

std::string ProgramGenerator::program() {
  std::string text = "0 BEGIN PGM T 1 MM\n";
  for (std::size_t lines = 1 + below(30); lines > 0; --lines) expand(text, "{line}", 0);
  return text += "99 END PGM T 1 MM\n";
}

std::string ProgramGenerator::damaged(std::string text) {
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t at = below(text.size());
    switch (below(4)) {
      case 0: text[at] = static_cast<char>(below(256)); break;
      case 1: text.erase(at, 1 + below(8)); break;
      case 2: text.insert(at, text.substr(below(text.size()), below(16))); break;
      default: text.insert(at, 1, "~;\"\n\t()=:/'Q%"[below(13)]); break;
    }
  }
  return text;
}

}  // namespace fitgauge::klartext

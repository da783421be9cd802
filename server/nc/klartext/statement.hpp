#pragma once

#include "nc/klartext/expression.hpp"

/// The content of a block, one small struct for each kind of block. All are trivially copyable:
/// texts, words and lists are in the Program's pools.
namespace fitgauge::klartext {

enum class Unit : std::uint8_t { Millimetre, Inch };

// --- frame of the program and blocks without effect

/// `BEGIN PGM name MM`.
struct BeginProgram {
  Text name{};
  Unit unit = Unit::Millimetre;
};

/// `END PGM name MM`; the last block.
struct EndProgram {
  Text name{};
  Unit unit = Unit::Millimetre;
};

/// A block of nothing but its comment or its number.
struct Empty {};

/// `* - text`: an outline entry; level 0 is the outermost.
struct Structure {
  Text text{};
  std::uint8_t level = 0;
};

/// `ERROR = raw text`: the control stores it for an unreadable line, the parser for every fault.
struct ErrorBlock {
  Text text{};
};

/// Something real controls can do and this one cannot: fails when it is reached.
struct Unsupported {
  Text feature{};  ///< its name for the message: "FK contour programming", "SQL"
  Text text{};     ///< the block as written, without number and comment
};

enum class BlankKind : std::uint8_t { Minimum, Maximum, Cylinder, Rotation, File };

/// `BLK FORM 0.1 Z X+0 Y+0 Z-20`, `0.2`, `CYLINDER`, `ROTATION`, `FILE`.
struct BlankForm {
  BlankKind kind = BlankKind::Minimum;
  std::optional<Axis> tool_axis{};
  Slice<Word> words{};
  Expr file{};  ///< Text or QS of FILE, otherwise Absent
};

// --- tools and motion

/// `TOOL CALL n|"name"|QSn axis S F DL DR DR2`. Words: S, F, FU, FZ, FMAX, FAUTO, DL, DR, DR2.
struct ToolCall {
  Expr tool{};  ///< a number, a Text name or a parameter; Absent when only speed or axis change
  std::optional<Axis> axis{};
  Slice<Word> words{};
};

/// `TOOL DEF n`: preselection, or the old definition `TOOL DEF 1 L+0 R+5`.
struct ToolDefinition {
  Expr tool{};
  Slice<Word> words{};
};

enum class Path : std::uint8_t {
#define FITGAUGE_PATH(path, spelling, words) path,
#include "nc/klartext/paths.inc"
#undef FITGAUGE_PATH
};

/// R+ and R- lengthen and shorten a paraxial path by the radius of the tool.
enum class RadiusCompensation : std::uint8_t { Unchanged, R0, Rl, Rr, RPlus, RMinus };
enum class Rotation : std::uint8_t { Unspecified, Positive, Negative };  ///< DR+ is anticlockwise

/// A positioning block. Words: axes, Pr, Pa, vectors, R, Len, Cca, Chamfer, feeds, M with
/// arguments.
struct Motion {
  Path path = Path::L;
  RadiusCompensation compensation = RadiusCompensation::Unchanged;
  Rotation rotation = Rotation::Unspecified;
  Slice<Word> words{};
};

/// A block with only M functions: `M3`, `M140 MB MAX`.
struct MFunctions {
  Slice<Word> words{};
};

/// `STOP` with optional M functions.
struct Stop {
  Slice<Word> words{};
};

// --- cycles

enum class CycleFamily : std::uint8_t { CyclDef, TchProbe, GlobalDef };

/// Returns the first words of its blocks: `CYCL DEF`.
constexpr std::string_view words_of(CycleFamily family) {
  switch (family) {
    case CycleFamily::TchProbe: return "TCH PROBE";
    case CycleFamily::GlobalDef: return "GLOBAL DEF";
    default: return "CYCL DEF";
  }
}

/// The right side of a cycle parameter's `=`.
enum class CycleValue : std::uint8_t {
  Expression,  ///< `Q262=+25`, `Q262=+Q5`, `QS400="0.1-0.1"`
  Auto,        ///< AUTO, FAUTO
  Max,         ///< MAX, FMAX
  Fu,          ///< `FU0.2`: the value is in `value`
  Fz,          ///< `FZ0.1`
  Predef       ///< PREDEF, from GLOBAL DEF
};

/// One line `Q262=+25 ;NOMINAL DIAMETER` of a cycle.
struct CycleParameter {
  QRef parameter{};
  CycleValue kind = CycleValue::Expression;
  Expr value{};
  Text comment{};         ///< the dialog text, as written
  Slice<char> written{};  ///< its place in the source, without the comment
};

/// A cycle in Q-form, one block: `CYCL DEF 200 DRILLING ~ Q200=...`, `TCH PROBE 421 ...`; or
/// values for PREDEF: `GLOBAL DEF 120 PROBING ~ Q320=...`.
struct Cycle {
  CycleFamily family = CycleFamily::CyclDef;
  std::uint16_t number = 0;
  Text dialog{};  ///< the free text after the number
  Slice<CycleParameter> parameters{};
};

/// A sub-line of a dotted cycle: `CYCL DEF 7.1 X+60`, `TCH PROBE 0.1 X+5 Y+0 Z-5`. Sub-line 0 opens
/// the cycle; those that follow in order belong to it.
struct CyclePart {
  CycleFamily family = CycleFamily::CyclDef;
  std::uint16_t number = 0;
  std::uint8_t part = 0;
  Text text{};  ///< all after the number as written: the title of part 0, dialog text and words
  /// The parsed part of the text; of a part 0 that is empty but for TCH PROBE 0.0.
  Slice<Word> words{};
};

enum class CycleCallKind : std::uint8_t { Here, Pattern, Position };

/// `CYCL CALL [M..]`, `CYCL CALL PAT F..`, `CYCL CALL POS X Y Z F..`.
struct CycleCall {
  CycleCallKind kind = CycleCallKind::Here;
  Slice<Word> words{};
};

enum class PatternElement : std::uint8_t { Pos, Row, Pat, Frame, Circ, PitchCirc };

/// `PATTERN DEF POS1( X+25 Y+33 Z+0 ) CIRC1( ... )`: the points of CYCL CALL PAT. Words: for each
/// element an Element and its number, then its own.
struct PatternDefinition {
  Slice<Word> words{};
};

// --- labels, programs, jumps

/// `LBL 5`, `LBL "NAME"`, or by the value of `LBL QS5`, `LBL Q0`. Names are kept as written and
/// compare without case.
using Label = std::variant<std::uint32_t, Text, QRef>;

/// `LBL n`; a Text or a number, never a parameter. Number 0 ends a subprogram.
struct LabelDefinition {
  Label label{};
};

/// `CALL LBL n [REP r]`.
struct LabelCall {
  Label label{};
  Expr repeat{};  ///< Absent: a subprogram call
};

/// FN 9 to 12: `IF a EQU b GOTO LBL x`, `IF Q1 IS UNDEFINED GOTO LBL x`.
struct ConditionalJump {
  Expr condition{};  ///< always a Node: Equal, NotEqual, Greater, Less, IsDefined or IsUndefined
  Label target{};
};

/// In the next three, a path is a Text, a QS parameter or a Concat of both (`TNC:\:'QS1'.H`).
struct CallProgram {
  Expr path{};
};

/// `SEL PGM path`.
struct SelectProgram {
  Expr path{};
};

/// `CALL SELECTED PGM`.
struct CallSelectedProgram {};

/// `SEL TABLE path`: the datum table.
struct SelectTable {
  Expr path{};
};

// --- parameters and functions

/// Spelling of an assignment; all forms have one meaning.
enum class AssignmentForm : std::uint8_t { Formula, Fn, DeclareString };

/// `Q5 = ...`, FN 0 to 8, 13 and 18, `DECLARE STRING QS1 = ...`. A QS target gets a text.
struct Assignment {
  QRef target{};
  AssignmentForm form = AssignmentForm::Formula;
  std::uint8_t fn = 0;  ///< of form Fn
  Expr value{};
};

/// `FN 0: Q5 SET UNDEFINED`.
struct SetUndefined {
  QRef target{};
};

/// FN 23 (3 points) and FN 24 (4 points): `Q20 = CDATA Q30`.
struct CircleData {
  QRef target{};
  QRef first_point{};
  std::uint8_t points = 3;
};

/// FN 14.
struct ErrorStop {
  Expr number{};
};

/// FN 15: `PRINT Q1/Q2/"text"`.
struct Print {
  Slice<Expr> items{};
};

/// FN 16: `F-PRINT mask / target`; paths as of CallProgram, or a device such as `SCREEN:`, `SCLR:`.
struct FormattedPrint {
  Expr mask{};
  Expr target{};
};

/// FN 17: `SYSWRITE ID50 NR4 IDXQ2 = Q1604`.
struct SystemWrite {
  Expr address{};  ///< a Node SystemAddress
  Expr value{};
};

/// FN 19, 29 (PLC), 37 (EXPORT), 38 (SEND: format, then values): only logged here.
struct ExternalFunction {
  std::uint8_t fn = 0;
  Slice<Expr> operands{};
};

/// FN 20: `WAIT FOR SYNC`, or for a condition of the PLC, stored as written.
struct WaitFor {
  Text condition{};
};

/// FN 26: path as of CallProgram.
struct TableOpen {
  Expr path{};
};

/// FN 27: `TABWRITE row/"A,B" = Q5`, Q6, ...
struct TableWrite {
  QRef first{};
  Expr cell{};  ///< a Node TableCell
};

/// FN 28: `TABREAD Q10 = row/"A,B"` into Q10, Q11, ...
struct TableRead {
  QRef first{};
  Expr cell{};  ///< a Node TableCell
};

// --- coordinate systems and modes

enum class Transformation : std::uint8_t { Datum, DatumTable, Mirror, Rotation, Scale };

/// `TRANS DATUM AXIS X+10`, `TRANS DATUM TABLE TABLINE5`, `TRANS MIRROR RESET`, ...
struct Trans {
  Transformation kind = Transformation::Datum;
  bool reset = false;
  Slice<Word> words{};  ///< axes; Row; Rot; Scl
  Expr table{};         ///< path of TRANS DATUM TABLE when given
};

enum class PlaneKind : std::uint8_t {
  Spatial,
  Projected,
  Euler,
  Vector,
  Points,
  Relativ,
  Axial,
  Reset
};
enum class PlanePositioning : std::uint8_t { Unspecified, Turn, Move, Stay };

/// `PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN MB50 FMAX SEQ- TABLE ROT`.
struct Plane {
  PlaneKind kind = PlaneKind::Spatial;
  PlanePositioning positioning = PlanePositioning::Unspecified;
  Slice<Word> words{};
};

/// `FUNCTION MODE MILL ["kinematics"]`.
struct FunctionMode {
  Text kinematics{};
};

/// `FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS` and `FUNCTION RESET TCPM`.
struct FunctionTcpm {
  bool active = true;
  Text options{};  ///< after TCPM, one blank between words
};

/// `FUNCTION DWELL TIME2`, `FUNCTION DWELL REV5`: seconds, or turns of the spindle.
struct Dwell {
  bool revolutions = false;
  Expr value{};
};

using Statement =
    std::variant<Empty, BeginProgram, EndProgram, Structure, ErrorBlock, Unsupported, BlankForm,
                 ToolCall, ToolDefinition, Motion, MFunctions, Stop, Cycle, CyclePart, CycleCall,
                 LabelDefinition, LabelCall, ConditionalJump, CallProgram, SelectProgram,
                 CallSelectedProgram, SelectTable, Assignment, SetUndefined, CircleData, ErrorStop,
                 Print, FormattedPrint, SystemWrite, ExternalFunction, WaitFor, TableOpen,
                 TableWrite, TableRead, Trans, Plane, FunctionMode, FunctionTcpm, PatternDefinition,
                 Dwell>;

}  // namespace fitgauge::klartext

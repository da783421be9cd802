#include "nc/program/cycles.hpp"

#include "nc/probing/parameters.hpp"

namespace fitgauge::interpreter {
namespace {

using probing::CycleFamily;
using probing::CycleKind;
using probing::q;
using probing::ValueKind;
using probing::parameter::choice, probing::parameter::coordinate, probing::parameter::feed,
    probing::parameter::kLongest, probing::parameter::length, probing::parameter::plain;

constexpr CycleParameter angle(int number, std::string_view meaning, double value = 0) {
  return probing::parameter::angle(number, meaning, kLongest, value);
}
constexpr CycleParameter count(int number, std::string_view meaning, double value) {
  return choice(number, meaning, 0, 99999, value);
}

/// Every parameter of these cycles once: a number means the same in each of them. The default of a
/// number is 0 if there is no other.
constexpr CycleParameter kParameters[] = {
    coordinate(1, "Milling depth"),
    plain(2, "Path overlap factor", 0.0001, 1.9999, 1),
    coordinate(3, "Allowance for the side"),
    coordinate(4, "Allowance for the floor"),
    coordinate(5, "Coordinate of the surface"),
    length(6, "Set-up clearance"),
    coordinate(7, "Clearance height"),
    length(8, "Inside corner radius"),
    choice(9, "Direction of rotation: +1 climb, -1 up-cut", -1, 1, 1),
    coordinate(10, "Plunging depth"),
    feed(11, "Feed rate for plunging"),
    feed(12, "Feed rate for milling"),
    count(13, "Number of the rough-out tool", 0),
    coordinate(14, "Allowance for the side"),
    count(18, "Coarse roughing tool", 0),
    feed(19, "Feed rate for reciprocation"),
    length(200, "Set-up clearance", 2),
    coordinate(201, "Depth"),
    length(202, "Plunging depth"),
    coordinate(203, "Coordinate of the surface"),
    length(204, "2nd set-up clearance"),
    length(205, "Minimum plunging depth"),
    feed(206, "Feed rate for plunging"),
    feed(207, "Feed rate for milling"),
    feed(208, "Feed rate for retraction"),
    plain(210, "Dwell time at the top, s", 0, 3600, 0),
    plain(211, "Dwell time at the depth, s", 0, 3600, 0),
    length(212, "Decrement"),
    count(213, "Number of breaks before retraction", 0),
    choice(214, "Disengaging direction: 0 none, 1 to 4", 0, 4, 0),
    choice(215, "Machining: 0 roughing and finishing, 1 roughing, 2 finishing", 0, 2),
    coordinate(216, "Centre in the main axis"),
    coordinate(217, "Centre in the secondary axis"),
    length(218, "Length of the 1st side"),
    length(219, "Length of the 2nd side, or width of the slot"),
    length(220, "Corner radius"),
    length(222, "Diameter of the blank"),
    length(223, "Diameter of the circle"),
    angle(224, "Angle of rotation"),
    coordinate(225, "Starting point in the main axis"),
    coordinate(226, "Starting point in the secondary axis"),
    coordinate(227, "Starting point in the tool axis"),
    coordinate(237, "Spacing in the main axis"),
    coordinate(238, "Spacing in the secondary axis"),
    coordinate(239, "Thread pitch"),
    choice(241, "Number of operations", 1, 99999, 1),
    count(242, "Number of columns", 1),
    count(243, "Number of rows", 1),
    length(244, "Pitch circle diameter"),
    angle(245, "Starting angle"),
    angle(246, "Stopping angle", 360),
    angle(247, "Stepping angle"),
    angle(248, "Angular length"),
    length(249, "Depth of the countersink on the other side"),
    length(250, "Material thickness"),
    length(251, "Off-centre distance"),
    length(252, "Height of the cutting edge"),
    feed(253, "Feed rate for pre-positioning", 1000),
    feed(254, "Feed rate for countersinking"),
    plain(255, "Dwell time, s", 0, 3600, 0),
    length(256, "Retraction for chip breaking", 0.2),
    length(257, "Plunging depth before chip breaking"),
    length(258, "Upper advanced stop distance", 0.2),
    length(259, "Lower advanced stop distance", 0.2),
    length(335, "Nominal diameter"),
    angle(336, "Angle of the spindle"),
    length(334, "Infeed per turn of the helix", 0.25),
    length(338, "Infeed for finishing"),
    count(339, "Threads per step", 0),
    length(340, "Feed of the countersink"),
    length(341, "Diameter of the pilot hole"),
    length(342, "Roughed-out diameter"),
    choice(343, "Select diameter or depth: 0 depth, 1 diameter", 0, 1),
    coordinate(344, "Diameter of the countersink"),
    choice(351, "Climb: +1 climb, -1 up-cut, 0 as the spindle turns", -1, 1, 1),
    count(355,
          "Threads per step: 0 one turn at the depth, 1 a helix of the whole depth, more several",
          0),
    coordinate(356, "Countersinking depth, in 264 depth of the hole"),
    length(357, "Clearance to the side"),
    coordinate(358, "Countersinking depth at the front"),
    length(359, "Offset of the countersinking at the front"),
    choice(360, "Countersinking: 0 before, 1 after threading", 0, 1),
    choice(365, "Type of traverse: 0 line, 1 arc", 0, 1),
    choice(366, "Plunging: 0 vertical, 1 helical, 2 reciprocating", 0, 2, 1),
    choice(367, "Position of the figure: 0 its centre, 1 to 4 its corners or ends", 0, 9),
    length(368, "Allowance for the side"),
    length(369, "Allowance for the floor"),
    plain(370, "Path overlap", 0.01, 1.9999, 1),
    angle(374, "Angle of rotation"),
    length(375, "Pitch circle diameter"),
    angle(376, "Starting angle"),
    choice(377, "Number of operations", 1, 99999, 1),
    angle(378, "Stepping angle"),
    length(379, "Deepened starting point, below the surface"),
    feed(385, "Feed rate for finishing", 500),
    coordinate(386, "End point in the tool axis"),
    choice(389, "Strategy: 0 meander outside, 1 meander within, 2 line by line", 0, 2, 2),
    choice(395, "Depth reference: 0 tip, 1 shoulder", 0, 1),
    choice(301, "Move to clearance height: 0 no, 1 yes", 0, 1),
    plain(403, "Factor of the speed for retraction", 0.0001, 10, 1),
    plain(401, "Factor of the feed", 0, 100, 100),
    length(424, "Length of the 1st side of the blank"),
    length(425, "Length of the 2nd side of the blank"),
    choice(426, "Spindle for entry and retraction: 3 M3, 4 M4, 5 M5", 3, 5, 5),
    plain(427, "Speed for entry and retraction", 0, kLongest, 20),
    plain(428, "Speed for drilling", 0, kLongest, 500),
    plain(429, "Coolant on", 0, 999, 8),
    plain(430, "Coolant off", 0, 999, 9),
    coordinate(435, "Dwell depth"),
    choice(437, "Starting point: 0 right of the stud, 1 to 4 its corners", 0, 4),
    choice(438, "Reference of the finishing: -1 to 2", -1, 32767, -1),
    choice(439, "Feed reference: 0 centre, 1 to 3 cutting edge", 0, 3),
    length(404, "Fine roughing strategy"),
    length(446, "Accepted remaining material", 0.01),
    length(447, "Longest connection"),
    length(448, "Path extension"),
    choice(453, "Spindle state", 0, 2),
    choice(460, "Corner cycle", 0, 1),
    {.id = q(500), .meaning = "Text to engrave", .kind = ValueKind::Text, .required = false},
    choice(512, "Feed rate for the approach", 0, 99999),
    length(513, "Height of the characters", 10),
    plain(514, "Factor of the spacing", 0, 10, 0),
    choice(515, "Font", 0, 1),
    choice(516, "Text: 0 on a line, 1 on a circle", 0, 1),
    length(517, "Diameter of the text's circle", 50),
    length(574, "Longest text")};

constexpr CycleParameter find(int number) {
  for (CycleParameter parameter : kParameters) {
    if (parameter.id != q(number)) continue;
    if (!parameter.is_text() && !parameter.default_value) parameter.default_value = 0;
    return parameter;
  }
  throw "a parameter that the table does not have";  // at compile time
}

/// Parameters of a cycle, in the order of the control's dialog.
template <int... Numbers>
constexpr std::array kOf{find(Numbers)...};
/// Also with the last position of Q367 for a cycle that has fewer.
template <int Last, int... Numbers>
constexpr auto kPlaced = [] {
  std::array all{find(Numbers)...};
  std::ranges::find(all, q(367), &CycleParameter::id)->range.max = Last;
  return all;
}();
constexpr auto k232 = [] {
  std::array all =
      kOf<389, 225, 226, 227, 386, 218, 219, 202, 369, 370, 207, 385, 253, 200, 357, 204>;
  for (CycleParameter& side : all) {
    if (side.id == q(218) || side.id == q(219)) side.range.min = -kLongest;
  }
  return all;
}();

constexpr std::string_view kDrillingText =
    "Every infeed, chip breaking, dwell and feed along the tool axis.";
constexpr std::string_view kPocketText =
    "The tool goes to each depth Q202 and around the finished contour there, its side and floor "
    "allowance left when only roughing (Q215 = 1).";
constexpr std::string_view kNoClearing =
    "Clearing the inside and the way of plunging (Q366, Q370): the tool plunges vertically beside "
    "the contour.";
constexpr std::string_view kStudText =
    "At each depth Q202 a half circle from beside the blank onto the contour, rounds no further "
    "from each other than Q370 times the tool's radius, and a half circle back. The allowances "
    "stay when only roughing (Q215 = 1), and in a block without Q215.";
constexpr std::string_view kThreadText =
    "Helix at the pitch, entered and left through the centre: one turn at the depth in 263 and "
    "264, the whole depth downwards in 265, by Q355 in 262 and 267; the countersinking of 263 to "
    "267 as a move to its depth.";
constexpr std::string_view kLabelsText =
    "The labels of the contours, each a subprogram: a pocket where the tool is inside of it by RL "
    "or RR and its direction, or without either; an island where it is outside. An open contour is "
    "closed by a line. Transformations in it hold in it alone; depths, feeds and M functions have "
    "no effect in it.";
constexpr std::string_view kPilotText =
    "Pecks at the points where cycle 22 plunges to mill along each contour with the tool Q13: its "
    "radius and Q3 beside the middle of the longest line or arc, down to the floor allowance Q4.";
constexpr std::string_view kRoughText =
    "Straight lanes along the main axis, no further from each other than Q2 times the tool's "
    "radius, clear the pockets around their islands; then the tool mills along each contour at its "
    "radius and Q3, in infeeds of Q10 down to the floor allowance Q4.";
constexpr std::string_view kFloorText = "As cycle 22, at the full depth at once.";
constexpr std::string_view kSideText =
    "Along each contour at the tool's radius and Q14, in infeeds of Q10 to the full depth, from "
    "the middle of its longest line or arc: counter-clockwise in pockets and clockwise around "
    "islands for Q9 = +1. In corners that are too small for the tool material stays.";
constexpr std::string_view kNoLanes =
    "The control's own way of clearing, contour-parallel, helical or reciprocating (Q19, Q404), "
    "and Q8: the tool plunges vertically for each lane. Contours that cross each other are each "
    "machined as a whole, and the way along one does not look at the others.";
constexpr std::string_view kNoArcs =
    "The arcs to the contour and away from it, and Q8: the tool plunges vertically beside the "
    "contour. Contours that cross each other are each machined as a whole.";
constexpr std::string_view kOldText = "As the cycle of today for it.";

constexpr MachiningCycle in_q(int number, std::string_view name, MachiningShape shape,
                              std::span<const CycleParameter> parameters,
                              std::string_view simulated, std::string_view not_simulated = {},
                              bool runs_when_defined = false) {
  return {{.family = CycleFamily::CyclDef,
           .number = static_cast<std::uint16_t>(number),
           .name = name,
           .kind = CycleKind::Machining,
           .parameters = parameters,
           .simulated = simulated,
           .not_simulated = not_simulated},
          shape,
          runs_when_defined};
}

constexpr MachiningCycle in_lines(int number, std::string_view name, MachiningShape shape,
                                  std::string_view simulated, std::string_view not_simulated = {}) {
  MachiningCycle cycle = in_q(number, name, shape, {}, simulated, not_simulated,
                              shape == MachiningShape::ContourLabels);
  cycle.descriptor.dotted = true;
  return cycle;
}

using Shape = MachiningShape;

constexpr MachiningCycle kCycles[] = {
    in_lines(1, "PECKING", Shape::Drilling, kDrillingText),
    in_lines(2, "TAPPING", Shape::Tapping, kDrillingText),
    in_lines(3, "SLOT MILLING", Shape::Slot, kOldText, kNoClearing),
    in_lines(4, "POCKET MILLING", Shape::RectangularPocket, kOldText, kNoClearing),
    in_lines(5, "CIRCULAR POCKET", Shape::CircularPocket, kOldText, kNoClearing),
    in_lines(14, "CONTOUR", Shape::ContourLabels, kLabelsText),
    in_lines(17, "RIGID TAPPING", Shape::Tapping, kDrillingText),
    in_lines(18, "THREAD CUTTING", Shape::Tapping, kDrillingText),
    in_q(20, "CONTOUR DATA", Shape::ContourData, kOf<1, 2, 3, 4, 5, 6, 7, 8, 9>,
         "Depth, surface, clearances, allowances, overlap and direction of cycles 21 to 24.", "",
         true),
    in_q(21, "PILOT DRILLING", Shape::Contour, kOf<10, 11, 13>, kPilotText),
    in_q(22, "ROUGH-OUT", Shape::Contour, kOf<10, 11, 12, 18, 19, 208, 401, 404, 438>, kRoughText,
         kNoLanes),
    in_q(23, "FLOOR FINISHING", Shape::Contour, kOf<11, 12, 208, 438>, kFloorText, kNoLanes),
    in_q(24, "SIDE FINISHING", Shape::Contour, kOf<9, 10, 11, 12, 14, 438>, kSideText, kNoArcs),
    in_q(200, "DRILLING", Shape::Drilling,
         kOf<200, 201, 206, 202, 210, 203, 204, 211, 395, 207, 208>, kDrillingText),
    in_q(201, "REAMING", Shape::Drilling, kOf<200, 201, 206, 211, 208, 203, 204>, kDrillingText),
    in_q(202, "BORING", Shape::Boring, kOf<200, 201, 206, 211, 208, 203, 204, 214, 336>,
         kDrillingText, "Turning the spindle to Q336; the tool withdraws by 0.2 mm."),
    in_q(203, "UNIVERSAL DRILLING", Shape::Drilling,
         kOf<200, 201, 206, 202, 210, 203, 204, 212, 213, 205, 211, 208, 256, 395>, kDrillingText),
    in_q(204, "BACK BORING", Shape::BackBoring,
         kOf<200, 249, 250, 251, 252, 253, 254, 255, 203, 204, 214, 336>, kDrillingText,
         "Turning the spindle to Q336."),
    in_q(205, "UNIVERSAL PECKING", Shape::Drilling,
         kOf<200, 201, 206, 202, 203, 204, 212, 205, 258, 259, 257, 256, 211, 379, 253, 208, 395>,
         kDrillingText),
    in_q(206, "TAPPING", Shape::Tapping, kOf<200, 201, 206, 211, 203, 204>, kDrillingText),
    in_q(207, "RIGID TAPPING", Shape::Tapping, kOf<200, 201, 239, 203, 204>, kDrillingText),
    in_q(208, "BORE MILLING", Shape::BoreMilling,
         kOf<200, 201, 206, 334, 203, 204, 335, 342, 351, 370>,
         "Helix of Q334 to the depth, a full circle there, back over the centre.",
         "Several rounds from the roughed-out diameter Q342."),
    in_q(209, "TAPPING W/ CHIP BRKG", Shape::Tapping,
         kOf<200, 201, 239, 203, 204, 257, 256, 336, 403>, kDrillingText),
    in_q(220, "POLAR PATTERN", Shape::PolarPattern,
         kOf<216, 217, 244, 245, 246, 247, 241, 200, 203, 204, 301, 365>,
         "Runs the cycle before it at each point.", "", true),
    in_q(221, "CARTESIAN PATTERN", Shape::LinearPattern,
         kOf<225, 226, 237, 238, 242, 243, 224, 200, 203, 204, 301, 460>,
         "Runs the cycle before it at each point, every second row backwards.", "", true),
    in_q(225, "ENGRAVING", Shape::Engraving,
         kOf<500, 513, 514, 515, 516, 374, 517, 207, 201, 206, 200, 203, 204, 367, 574>,
         "The tool goes to the depth where the text begins.",
         "The strokes and the places of the characters: the font is the control's."),
    in_q(232, "FACE MILLING", Shape::FaceMilling, k232,
         "Lanes along the main axis, evenly spaced by at most Q370 times the tool's radius, the "
         "last one up to the edge; equal infeeds of at most Q202, the last one of Q369 at Q385. "
         "Each infeed goes through the lanes in reverse. With Q389 = 1 the next lane is reached "
         "at Q207, else at Q253.",
         "A tooth radius R2, which makes the lanes of the control narrower."),
    in_q(240, "CENTERING", Shape::Drilling,
         kOf<200, 343, 201, 344, 206, 211, 203, 204, 341, 342, 395>, kDrillingText),
    in_q(241, "SINGLE-LIP D.H.DRLNG", Shape::Drilling,
         kOf<200, 201, 206, 211, 203, 204, 379, 253, 208, 426, 427, 428, 429, 430, 435, 401, 202,
             212, 205>,
         "Entry to the deepened starting point and retraction at the speed Q427, the spindle by "
         "Q426; drilling at Q428 with coolant (Q429, Q430); beyond the dwell depth Q435 at Q401 "
         "percent of the feed. Infeeds dwell (Q211) without retraction. Then speed, spindle and "
         "coolant are as before.",
         "M functions other than M8 and M9 in Q429 and Q430."),
    in_q(251, "RECTANGULAR POCKET", Shape::RectangularPocket,
         kPlaced<4, 215, 218, 219, 220, 368, 224, 367, 207, 351, 201, 202, 369, 206, 338, 200, 203,
                 204, 370, 366, 385, 439>,
         kPocketText, kNoClearing),
    in_q(252, "CIRCULAR POCKET", Shape::CircularPocket,
         kOf<215, 223, 368, 207, 351, 201, 202, 369, 206, 338, 200, 203, 204, 370, 366, 385, 439>,
         kPocketText, kNoClearing),
    in_q(253, "SLOT MILLING", Shape::Slot,
         kPlaced<4, 215, 218, 219, 368, 374, 367, 207, 351, 201, 202, 369, 206, 338, 200, 203, 204,
                 366, 385, 439>,
         kPocketText, kNoClearing),
    in_q(254, "CIRCULAR SLOT", Shape::CircularSlot,
         kPlaced<3, 215, 219, 368, 375, 367, 216, 217, 376, 248, 378, 377, 207, 351, 201, 202, 369,
                 206, 338, 200, 203, 204, 366, 385, 439>,
         kPocketText, kNoClearing),
    in_q(256, "RECTANGULAR STUD", Shape::RectangularStud,
         kPlaced<4, 218, 424, 219, 425, 220, 368, 224, 367, 207, 351, 201, 202, 206, 200, 203, 204,
                 370, 437, 215, 369, 338, 385>,
         kStudText,
         "Q437: every stud is approached 2 mm to the right of the blank. Finishing as a separate "
         "step (Q338, Q385)."),
    in_q(257, "CIRCULAR STUD", Shape::CircularStud,
         kOf<223, 222, 368, 207, 351, 201, 202, 206, 200, 203, 204, 370, 376, 215, 369, 338, 385>,
         kStudText,
         "Finishing as a separate step (Q338, Q385). The tool comes from 2 mm beside the blank at "
         "Q376."),
    in_q(262, "THREAD MILLING", Shape::ThreadMilling,
         kOf<335, 239, 201, 355, 253, 351, 200, 203, 204, 207, 512>, kThreadText),
    in_q(263, "THREAD MLLNG/CNTSNKG", Shape::ThreadMilling,
         kOf<335, 239, 201, 356, 253, 351, 200, 357, 358, 359, 203, 204, 254, 207, 512>,
         kThreadText),
    in_q(264, "THREAD DRILLNG/MLLNG", Shape::ThreadMilling,
         kOf<335, 239, 201, 356, 253, 351, 202, 258, 257, 256, 358, 359, 200, 203, 204, 206, 207,
             512>,
         kThreadText),
    in_q(265, "HEL. THREAD DRLG/MLG", Shape::ThreadMilling,
         kOf<335, 239, 201, 253, 358, 359, 360, 200, 203, 204, 254, 207>, kThreadText),
    in_q(267, "OUTSIDE THREAD MLLNG", Shape::ThreadMilling,
         kOf<335, 239, 201, 355, 253, 351, 200, 358, 359, 203, 204, 254, 207, 512>, kThreadText),
};

/// A value that must not stand in that relation to another one, or to 0.
struct Rule {
  int error;
  int parameter;
  std::string_view relation;
  int other;
  bool (*is_wrong)(double value, double other);
  std::array<int, 11> cycles;  ///< none: all that have the parameter
};

constexpr auto kLess = [](double value, double other) { return value < other; };
constexpr auto kMore = [](double value, double other) { return value > other; };
constexpr auto kMoreThanHalf = [](double value, double other) { return value > other / 2; };
constexpr auto kZero = [](double value, double) { return value == 0; };
constexpr auto kPositive = [](double value, double) { return value > 0; };
constexpr auto kReaches = [](double value, double depth) {
  return value > 0 && depth != 0 && value >= std::abs(depth);
};

constexpr Rule kRules[] = {
    {kDepthPositive, 201, kDepthNeeds, 201, kPositive, {}},
    {kDepthPositive, 1, kDepthNeeds, 1, kPositive, {20}},
    {kDepthPositive, 356, kDepthNeeds, 356, kPositive, {263, 264}},
    {1016, 379, "reaches the depth", 201, kReaches, {205, 241}},
    {1098, 424, "is less than", 218, kLess, {256}},
    {1098, 425, "is less than", 219, kLess, {256}},
    {1036, 222, "is less than", 223, kLess, {257}},
    {1011, 218, "is less than", 219, kLess, {3, 253}},
    {1016, 386, "lies above", 227, kMore, {232}},
    {1042, 201, "", 201, kZero, {}},
    {1042, 249, "", 249, kZero, {204}},
    {1010, 206, "", 206, kZero, {200, 201, 202, 203, 205, 206, 208, 225, 240, 241}},
    {1010, 206, "", 206, kZero, {251, 252, 253, 254, 256, 257}},
    {1010, 207, "", 207, kZero, {251, 252, 253, 254, 256, 257, 262, 263, 264, 265, 267}},
    {1011, 239, "", 239, kZero, {207, 209, 262, 263, 264, 265, 267}},
    {1011, 334, "", 334, kZero, {208}},
    {1023, 220, "is more than half of", 218, kMoreThanHalf, {4, 251}},
    {1023, 220, "is more than half of", 219, kMoreThanHalf, {4, 251}},
    {1086, 369, "leaves nothing of", 201, kReaches, {}},
    {1106, 248, "", 248, kZero, {254}},
};

}  // namespace

std::optional<CycleContradiction> contradiction(
    int cycle, const std::function<std::optional<double>(int)>& value) {
  for (const Rule& rule : kRules) {
    const bool is_for_all = rule.cycles.front() == 0;
    if (!is_for_all && !std::ranges::count(rule.cycles, cycle)) continue;
    // 240 may have the diameter instead.
    if (is_for_all && cycle == 240 && value(343) != 0) continue;
    const auto one = value(rule.parameter);
    const auto other = value(rule.other);
    if (!one || !other || !rule.is_wrong(*one, *other)) continue;
    // 1 to 18 name it in words.
    std::string text = cycle < 20 && rule.parameter == 201
                           ? fmt::format("the depth {}", *one)
                           : fmt::format("Q{} = {}", rule.parameter, *one);
    if (!rule.relation.empty()) text += fmt::format(" {}", rule.relation);
    if (rule.other != rule.parameter) text += fmt::format(" Q{} = {}", rule.other, *other);
    return CycleContradiction{rule.error, rule.parameter, rule.other, std::move(text)};
  }
  return std::nullopt;
}

std::span<const MachiningCycle> machining_cycles() { return kCycles; }

const MachiningCycle* machining_cycle(int number) {
  const auto* found = std::ranges::find_if(
      kCycles, [number](const MachiningCycle& cycle) { return cycle.descriptor.number == number; });
  return found == std::ranges::end(kCycles) ? nullptr : found;
}

}  // namespace fitgauge::interpreter

#pragma once

/// Tolerances of equality, by what is compared: the one place for machine, cycles and interpreter.
/// Results are written in whole nanometres (decision 21), and a double keeps 1e-13 mm at one metre;
/// all decisions are between these two. Begin, step and end of a search are not decisions about a
/// part: their constants are at the search.
namespace fitgauge::tolerance {

// Lengths in mm.

/// Smallest reported length: a smaller overlap of ball and material is a contact, and a smaller
/// error counts as zero.
inline constexpr double kNanometre = 1e-6;
/// Points nearer than this are equal, and a point this near to a face or a limit is on it: a
/// thousandth of the smallest reported length, so that sums of hundreds of roundings do not show.
inline constexpr double kSamePoint = 1e-9;
/// Smaller clearances count as none: a fit through several contacts then still keeps kSamePoint.
inline constexpr double kContact = 1e-11;
/// Along a path: places that a double cannot distinguish.
inline constexpr double kRounding = 1e-13;
/// Accepted distance of an arc's end from its circle, as on the control.
inline constexpr double kBesideCircle = 0.016;
/// A chord that exceeds its diameter by less counts as the diameter, as on the control.
inline constexpr double kLongChord = 0.001;
/// A path of turning axes is followed in straight pieces that leave it by less.
inline constexpr double kSag = 5e-4;

// Angles in degrees.

/// Written angles are decimals: whole billionths of a degree.
inline constexpr double kSameAngle = 1e-9;
/// Greatest distance of an angle from its tooth of a Hirth grid, after preset and datum shift.
inline constexpr double kOnTooth = 1e-6;
/// Angle by which a tool may leave the plane of PATHCTRL VECTOR between two stops, in degrees.
inline constexpr double kToolVectorDeg = 1e-3;

// Directions: the sine of the angle between them.

/// Directions are equal up to this sine: at a lever of a metre they lead to one nanometre.
inline constexpr double kSameDirection = 1e-9;
/// Lines that do not meet: common points would be rounding.
inline constexpr double kParallel = 1e-12;
/// Touched edges without a corner: it would be a million times their distance away.
inline constexpr double kParallelEdges = 1e-6;
/// Rotary axes that the path of the sphere can distinguish.
inline constexpr double kAcross = 1e-3;
/// chkTiltingAxes, 0.006 degrees: the tool is square to its plane.
inline constexpr double kSquare = 1e-4;

// Without a unit.

/// Points are on a line if they are nearer to it than this part of their distance.
inline constexpr double kCollinear = 1e-9;
/// An error of the kinematics is undetermined if it moves the sphere by less than this part of the
/// error.
inline constexpr double kSeen = 1e-3;
/// EQU and NE, of the larger of 1 and both numbers (decision 2).
inline constexpr double kEqualNumbers = 1e-9;

}  // namespace fitgauge::tolerance

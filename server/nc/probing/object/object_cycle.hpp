#pragma once

#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/probing_motion.hpp"

/// The common part of cycles 1400 to 1434: toleranced dimensions, clearance (Q1125), extrusion
/// (1493), results from Q950 on with the status Q183, the page TCHPRAUTO.html, transfer of position
/// (Q1120) and rotation (Q1121) into the active preset, and Q309.
namespace fitgauge::probing {

/// A nominal dimension of cycles 1400 to 1434.
struct Nominal {
  Length target;  ///< the middle of the tolerance: target of probing and comparison
  std::optional<Limits> limits{};  ///< nothing without a tolerance
};

/// Reads QS1100 to QS1117: a dimension, in the unit of the program, with its tolerance.
///
///     50            none
///     50+0.2-0.1    deviations; `50+0.2` and `50-0.1` have 0 as the other one; `50+-0.1`
///     10H7, 10m     a class of ISO 286; f, m, c or v of ISO 2768-1
///
/// @errors 1004 a size below 0; 1011 what cannot be read, or a class that the size does not have;
///   1097 `?` and `@`: the operator gives the position.
CycleResult<Nominal> parse_nominal(const CycleParameter& parameter, std::string_view text,
                                   bool inch);

/// Reads QS400, the tolerance of cycle 444: the permitted deviations along the surface normal.
///
///     0.4-0.1   upper limit +0.4, lower limit -0.1
///     0.4       upper limit +0.4, lower limit 0
///     -0.1      upper limit 0, lower limit -0.1
///     0.1+0.1   no tolerance, as an empty text, blanks alone and 0
///
/// Numbers are of the unit of the program, with decimal point or comma, without blanks; finer
/// digits are rounded to the nearest nanometre.
/// @errors 1011 naming the position, from 1, of the character that has no place there; also more
///   than 255 characters. 1004 a number beyond 99999.9999.
CycleResult<std::optional<Limits>> parse_tolerance(std::string_view text, bool inch);
/// The tolerance of a block, none if QS400 is left out.
CycleResult<std::optional<Limits>> tolerance_of(const Arguments& arguments, bool inch);

/// A verdict in Q183 and in the log. @see kStatusResult
struct ObjectStatus {
  int q183 = -1;
  std::string_view style = "none";
  std::string_view words = "– No tolerance";

  static ObjectStatus of(const std::optional<gauging::Verdict>& verdict);
  /// By Q309: 1 out of tolerance, 2 for reject alone; without a tolerance nothing stops (decision
  /// 14).
  bool stops(int q309) const { return q183 == 2 ? q309 != 0 : q183 == 1 && q309 == 1; }
};

/// A point of the nominal part and of the real one, in plane coordinates.
struct ObjectPoint {
  Vec3 nominal;
  Vec3 measured;
  std::array<std::optional<Limits>, 3> limits{};
  Vec3 touched{};  ///< the probing direction if it is on a face; otherwise zero

  /// A face was found there along that direction.
  void touch(const Vec3& surface, const Vec3& direction) {
    measured = nominal + direction * dot(surface - nominal, direction);
    touched = direction;
  }
};

/// An angle: its result, and the deviation from the nominal one in the Q parameter 30 higher.
struct ObjectAngle {
  std::string_view name;
  int result_q;
  double measured;  ///< degrees
  double deviation;
};

/// The result of a cycle.
struct ObjectFound {
  std::vector<ObjectPoint> points{};
  std::vector<MeasuredValue> sizes{};
  std::vector<ObjectAngle> angles{};
  std::optional<Form> form{};
  machine::Matrix3 turn{};           ///< of the part from nominal to real, in plane coordinates
  std::optional<double> turn_deg{};  ///< around the probe axis
};

/// One execution of such a cycle. @errors 1011 and 1097 of dimensions, 1014 nothing to touch, 1085
/// the row of the preset is locked, 1016 and 1100 the table cannot turn so, 1016 the extrusion is
/// not square to a touch, a tolerance stop 1072.
class ObjectProbing {
 public:
  /// @errors 1007, 1008, 1097 and those of ProbingMotion::begin.
  static CycleResult<ObjectProbing> begin(const CycleContext& context);

  const Arguments& arguments() const { return context_; }
  const machine::Frames& frames() const { return context_.state().frames; }
  const ProbingMotion& motion() const { return motion_; }
  /// Further back by the approach of an undercut (Q1118).
  double start_distance() const { return motion_.start_distance() + context_.number_or(1118, 0); }
  CycleResult<Nominal> size(int parameter) const;
  /// Three coordinates, from that parameter on.
  CycleResult<ObjectPoint> point(int first) const;
  Touch towards(const Vec3& point, const Vec3& direction) const {
    return {.start = point - direction * start_distance(), .direction = direction};
  }
  /// Touches objects by Q1125 and the extrusion; contacts in the order of the touches.
  CycleResult<std::vector<Contact>> touch(const std::vector<std::vector<Touch>>& objects);
  CycleResult<void> finish(const ObjectFound& found);

 private:
  ObjectProbing(const CycleContext& context, const ProbingMotion& motion)
      : context_(context), motion_(motion) {}
  CycleResult<void> transfer(const ObjectFound& found);

  const CycleContext& context_;
  ProbingMotion motion_;
};

/// Q372: a unit vector.
Vec3 object_direction(const Arguments& arguments);
/// The angles Q964 and Q965 of a line, in the working plane or to it, and the resulting turn.
void add_line(ObjectFound& found, const ObjectProbing& probing, const Vec3& nominal,
              const Vec3& measured, bool is_level);
/// Returns the face of a touch; the ball does not touch an oblique face with its foremost point.
Vec3 face_behind(const Contact& contact, const Vec3& direction, const Vec3& normal,
                 double ball_radius);
/// The shortest turn that brings one direction into another. @pre neither is zero.
machine::Matrix3 shortest_turn(const Vec3& from, const Vec3& to);
/// Checks for the linker that the texts of dimensions can be read.
CycleResult<void> check_dimensions(const Arguments& arguments);

namespace parameter {

constexpr CycleParameter with_tolerance(CycleParameter dimension) {
  dimension.kind = ValueKind::NumberOrText;
  return dimension;
}
constexpr CycleParameter position(int number, std::string_view meaning) {
  return with_tolerance(coordinate(number, meaning));
}
constexpr CycleParameter size(int number, std::string_view meaning) {
  return with_tolerance(length(number, meaning));
}
inline constexpr std::array kPoint1{position(1100, "1st point, main axis"),
                                    position(1101, "1st point, secondary axis"),
                                    position(1102, "1st point, probe axis")};
inline constexpr std::array kPoint2{position(1103, "2nd point, main axis"),
                                    position(1104, "2nd point, secondary axis"),
                                    position(1105, "2nd point, probe axis")};
inline constexpr CycleParameter kObjectDirection =
    at_least(1, choice(372, "Direction: 1 main, 2 secondary, 3 probe axis, with its sign", -3, 3));
inline constexpr std::array kObject = list(
    kSetUpClearance, kClearanceHeight,
    choice(
        1125,
        "Mode of the clearance height: -1 never, 0 around the cycle, 1 each object, 2 each point",
        -1, 2, 1),
    choice(309, "Stop out of tolerance: 0 no, 1 yes, 2 for reject alone", 0, 2, 0));
constexpr CycleParameter transfer_position(double most) {
  return choice(1120, "Transfer into the preset: 0 none, point 1, 2, ..., last: the mean", 0, most,
                0);
}
constexpr std::array<CycleParameter, 3> transfer_all(double most_position, double most_rotation) {
  return {choice(1126, "Rotary axis: 0 stays, 1 and 2 turn the table, with Q1121 = 2", 0, 2, 0),
          transfer_position(most_position),
          choice(1121, "Transfer of the rotation: 0 none, 1 basic rotation, 2 offset of the table",
                 0, most_rotation, 0)};
}

}  // namespace parameter

inline constexpr CycleOutput kStatusResult{
    183, "Status: -1 no tolerance, 0 good, 1 rework, 2 reject", Unit::None};

/// Points, further results, the deviation of each, the status.
template <std::size_t Points, std::size_t More>
constexpr auto object_results(const std::array<CycleOutput, More>& more) {
  constexpr std::string_view kNames[] = {
      "1st point, main axis", "1st point, secondary axis", "1st point, probe axis",
      "2nd point, main axis", "2nd point, secondary axis", "2nd point, probe axis",
      "3rd point, main axis", "3rd point, secondary axis", "3rd point, probe axis"};
  std::array<CycleOutput, 6 * Points + 2 * More + 1> all{};
  auto* next = all.data();
  const auto add = [&](int q, std::string_view name, Unit unit) {
    *next++ = {static_cast<std::uint16_t>(q), name, unit};
    *next++ = {static_cast<std::uint16_t>(q + 30), "Deviation of it", unit};
  };
  for (std::size_t i = 0; i < 3 * Points; ++i)
    add(950 + static_cast<int>(i), kNames[i], Unit::Length);
  for (const CycleOutput& result : more) add(result.q, result.meaning, result.unit);
  *next = kStatusResult;
  return all;
}
inline constexpr CycleOutput kDiameterResult{966, "Diameter", Unit::Length};
inline constexpr CycleOutput kAngleResult{964, "Angle in the input system", Unit::Angle};
inline constexpr CycleOutput kTableAngleResult{965, "Angle in the system of the table",
                                               Unit::Angle};

/// The descriptor of such a cycle; `more` are errors in addition to the common ones.
constexpr TouchProbeCycle object_cycle(std::uint16_t number, std::string_view name,
                                       std::span<const CycleParameter> parameters,
                                       std::span<const CycleOutput> results, const ErrorSet& more,
                                       CycleFunction run, ArgumentCheck check = check_dimensions) {
  TouchProbeCycle made = cycle(
      number, name, CycleKind::Measuring, parameters, results,
      errors::kUnscaled | more | ErrorSet{1011, 1016, 1072, 1085, 1097}, run,
      "All other parameters. A dimension with a tolerance is probed at, compared with and "
      "transferred from the middle of it. A basic rotation stays active. Results are logged in "
      "TCHPRAUTO.html and transferred into the row of the active preset before Q309 stops.",
      "Semi-automatic probing (`?`) and given actual positions (`@`): the block is refused. An "
      "L-shaped stylus: only the ball touches and collides.");
  made.check = check;
  return made;
}

}  // namespace fitgauge::probing

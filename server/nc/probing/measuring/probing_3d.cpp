#include "log_templates.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/object/object_cycle.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::probing_3d {

using gauging::Verdict;
using machine::Vec3;
using namespace fmt::literals;
using namespace parameter;

/// A point that cycle 444 has touched. Coordinates and components along main, secondary and probe
/// axis, in whole nanometres; along the normal, positive is away from the material.
struct ProbedPoint {
  WorkingPlane plane;
  Vec3 normal;          ///< of the surface, length 1
  double distance = 0;  ///< DIST, mm: the length that the log draws the probing direction with
  std::array<Length, 3> nominal{};
  std::array<Length, 3> measured{};
  Length deviation;                  ///< along the normal
  std::optional<Limits> limits{};    ///< of that deviation
  std::optional<Verdict> verdict{};  ///< nothing without limits
};

constexpr HtmlLog k444Log{"TCHPR444.html", "Measuring log of cycle 444",
                          "Measuring log of touch-probe cycle 444 PROBING IN 3-D",
                          "Along the normal, positive is away from the material."};

/// Styles of the values along the axes and along the normal.
using Styles = std::array<std::string_view, 4>;

/// A row of a value along each axis and one along the normal.
std::string row(std::string_view label, const std::array<Length, 3>& along_axes,
                Length along_normal, bool inch, const Styles& styles = {}) {
  const auto cell = [&](Length value, std::string_view style) {
    const std::string text = log_text(value, inch);
    return style.empty()
               ? fmt::format(templates::point::cell, "value"_a = text)
               : fmt::format(templates::point::judged_cell, "style"_a = style, "value"_a = text);
  };
  return fmt::format(
      templates::point::row, "label"_a = label, "main"_a = cell(along_axes[0], styles[0]),
      "secondary"_a = cell(along_axes[1], styles[1]), "probe"_a = cell(along_axes[2], styles[2]),
      "normal"_a = cell(along_normal, styles[3]));
}

std::array<Length, 3> components(const Vec3& normal, double length) {
  return {to_length(normal.x * length), to_length(normal.y * length), to_length(normal.z * length)};
}

/// Styles of each axis by its share of the tolerance (decision 24), and last along the normal.
/// Deviations across the normal have no share.
Styles styles_of(const ProbedPoint& point) {
  Styles styles{};
  if (!point.limits) return styles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double share = point.normal[axis];
    const double away = (point.measured[axis] - point.nominal[axis]).to_mm() * (share < 0 ? -1 : 1);
    const auto limit = [&](Length along_normal) {
      return to_length(along_normal.to_mm() * std::abs(share));
    };
    if (limit(point.limits->upper) == limit(point.limits->lower)) continue;
    const Length value = to_length(away);
    const Verdict verdict = value > limit(point.limits->upper)   ? Verdict::Rework
                            : value < limit(point.limits->lower) ? Verdict::Reject
                                                                 : Verdict::Good;
    styles.at(axis) = ObjectStatus::of(verdict).style;
  }
  styles.back() = ObjectStatus::of(point.verdict).style;
  return styles;
}

std::array<Length, 3> sum(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::array<Length, 3> difference(const std::array<Length, 3>& a, const std::array<Length, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

std::string rows(const ProbedPoint& point, bool inch) {
  std::string rows = row("Probing direction vector", components(point.normal, -point.distance),
                         to_length(-point.distance), inch) +
                     row("Nominal", point.nominal, Length{}, inch);
  if (point.limits) {
    const auto limit = [&](std::string_view label, Length along_normal) {
      return row(label, sum(point.nominal, components(point.normal, along_normal.to_mm())),
                 along_normal, inch);
    };
    rows += limit("Upper limit", point.limits->upper) + limit("Lower limit", point.limits->lower);
  }
  const Styles styles = styles_of(point);
  rows += row("Actual", point.measured, point.deviation, inch, styles);
  rows +=
      row("Deviation", difference(point.measured, point.nominal), point.deviation, inch, styles);
  return rows;
}

std::string section(const CycleHost& host, const ProbedPoint& point) {
  const ObjectStatus status = ObjectStatus::of(point.verdict);
  const std::string_view beyond = status.q183 == 1   ? ": above the upper limit"
                                  : status.q183 == 2 ? ": below the lower limit"
                                                     : "";
  return fmt::format(
      templates::point::section, "when"_a = date_and_time(host), "style"_a = status.style,
      "words"_a = fmt::format("{}{}", status.words, beyond), "q183"_a = status.q183,
      "main"_a = name(point.plane.main), "secondary"_a = name(point.plane.secondary),
      "probe"_a = name(point.plane.probe), "rows"_a = rows(point, host.log_is_inch()));
}

constexpr std::array kParameters = list(
    coordinates(263, "Nominal point, main axis", "Nominal point, secondary axis"),
    coordinate(294, "Nominal point, probe axis"), plain(581, "Surface normal, main axis", -10, 10),
    plain(582, "Surface normal, secondary axis", -10, 10),
    plain(583, "Surface normal, probe axis", -10, 10), kSetUpClearance, kClearanceHeight,
    tolerance_text("Tolerance along the normal, such as \"0.4-0.1\""),
    choice(309, "Stop out of tolerance: 0 no, 1 yes, 2 below the lower limit", 0, 2, 0));

constexpr std::array kPointResults =
    results(151, Unit::Length, "Point, main axis", "Point, secondary axis", "Point, probe axis");
constexpr std::array kResults =
    list(kPointResults,
         results(161, Unit::Length, "Deviation, main axis", "Deviation, secondary axis",
                 "Deviation, probe axis", "Deviation along the surface normal"),
         kStatusResult);

/// The normal is not zero and QS400 can be read, in whatever unit.
CycleResult<void> check_arguments(const Arguments& arguments) {
  const auto is_zero = [&](int component) {
    return arguments.has_number(q(component)) && arguments.number(component) == 0;
  };
  if (is_zero(581) && is_zero(582) && is_zero(583)) {
    return nc_error(1042,
                    "Q581, Q582 and Q583 are 0: give the surface normal, away from the material");
  }
  TRY(tolerance_of(arguments, false));
  return {};
}

/// @pre check_arguments has accepted them.
Vec3 surface_normal(const Arguments& arguments) {
  const Vec3 normal = place_of(arguments, 581, 582, 583);
  // The largest component decides, since squares of tiny ones would vanish.
  const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  return unit(normal * (1 / largest));
}

/// Machine parameter chkTiltingAxes: a tool that TCPM does not incline is square to a tilted plane.
CycleResult<void> check_tilting_axes(const machine::MachineState& state, machine::Axis probe) {
  if (!state.frames.is_tilted() || state.modes.tcpm) return {};
  if (norm(state.tool_direction() - unit_vector(probe)) <= tolerance::kSquare) return {};
  return nc_error(1099,
                  "the rotary axes do not stand as the tilted plane needs them; position them, or "
                  "incline the probe with FUNCTION TCPM");
}

/// Too much material along the normal is an outside size above its limit: rework (decision 11).
MeasuredValue normal_deviation(const ProbedPoint& point) {
  return {.characteristic = "Deviation along the surface normal",
          .role = ValueRole::ShaftSize,
          .measured = point.deviation,
          .limits = point.limits};
}

CycleResult<ProbedPoint> touch_point(const CycleContext& context,
                                     const std::optional<Limits>& limits) {
  const machine::MachineState& state = context.state();
  const Vec3 normal = surface_normal(context);
  TRY(refuse_mirror_and_scaling(state.frames));
  auto motion = TRY(ProbingMotion::begin(context));
  TRY(check_tilting_axes(state, motion.plane().probe));
  const Vec3 nominal = place_of(context, 263, 264, 294);
  const auto contact =
      TRY(motion.touch({.start = nominal + normal * motion.start_distance(), .direction = -normal},
                       context.number(260)));
  const Vec3 surface = contact.surface;

  ProbedPoint point{.plane = motion.plane(),
                    .normal = normal,
                    .distance = state.probe_system()->data.distance,
                    .deviation = to_length(dot(surface - nominal, normal)),
                    .limits = limits};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    point.nominal[axis] = to_length(nominal[axis]);
    point.measured[axis] = to_length(surface[axis]);
  }
  point.verdict = normal_deviation(point).verdict();
  return point;
}

void write_results(CycleHost& host, const ProbedPoint& point) {
  for (std::uint16_t axis = 0; axis < 3; ++axis) {
    const auto result = [&](int first) { return static_cast<std::uint16_t>(first + axis); };
    host.set_q(result(151), point.measured[axis].to_mm(), Unit::Length);
    host.set_q(result(161), (point.measured[axis] - point.nominal[axis]).to_mm(), Unit::Length);
  }
  host.set_q(164, point.deviation.to_mm(), Unit::Length);
  host.set_q(kStatusResult.q, ObjectStatus::of(point.verdict).q183, Unit::None);
}

MeasuringRecord make_record(const ProbedPoint& point) {
  MeasuringRecord record{.cycle = 444,
                         .sizes = {normal_deviation(point)},
                         .has_status = true,
                         .verdict = point.verdict};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    record.sizes.push_back({.characteristic = kPointResults[axis].meaning,
                            .role = ValueRole::Position,
                            .nominal = point.nominal[axis],
                            .measured = point.measured[axis]});
  }
  return record;
}

CycleResult<void> measure(const CycleContext& context) {
  CycleHost& host = context.host;
  host.set_q(kStatusResult.q, -1, Unit::None);
  const auto limits = TRY(tolerance_of(context, host.block_is_inch()));
  const auto point = TRY(touch_point(context, limits));

  write_results(host, point);
  TRY(add_section(host, k444Log, section(host, point)));
  host.record(make_record(point));
  if (ObjectStatus::of(point.verdict).stops(context.whole(309))) return tolerance_stop(1072);
  return {};
}

constexpr TouchProbeCycle kCycles[] = {
    {{.number = 444,
      .name = "PROBING IN 3-D",
      .kind = CycleKind::Measuring,
      .parameters = kParameters,
      .results = kResults,
      .errors = errors::kUnscaled | ErrorSet{1004, 1011, 1042, 1072, 1099},
      .simulated =
          "All parameters. QS400 is in the unit of the program. After contact the probe goes back "
          "to the start (MB) and stays there. A basic rotation stays active. In a tilted plane the "
          "rotary axes must stand square to it, except with TCPM. The points of a run share one "
          "log, which colours the value along the normal and each axis against its share of the "
          "tolerance. Q309 = 2 stops when the point lies below the lower limit, and without a "
          "tolerance never. Two manuals say below the nominal coordinate; but Q309 is the reaction "
          "to a tolerance error, and the same page says that the program can be made to stop after "
          "a determined undersize."},
     measure,
     check_arguments}};

}  // namespace fitgauge::probing::probing_3d

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kProbing3dCycles = probing_3d::kCycles;

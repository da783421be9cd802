#include "nc/machine/machine_setup.hpp"

#include "nc/machine/tolerance.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {
namespace {

constexpr double kLongestMm = 1e6;
constexpr double kLargestDeg = 36000;

/// Collects the faults, each with its JSON pointer.
class Findings {
 public:
  void add(std::string where, std::string message, ErrorCode code = ErrorCode::FieldInvalid) {
    found_.push_back({code, std::move(message), std::move(where), {}});
  }
  void conflict(std::string where, std::string message) {
    add(std::move(where), std::move(message), ErrorCode::FieldConflict);
  }
  /// A finite number between two bounds, both included.
  void within(const std::string& where, double value, double least, double most) {
    if (value >= least && value <= most) return;
    add(where, fmt::format("must be {} to {}", least, most));
  }
  void positive(const std::string& where, double value, double most = kLongestMm) {
    if (value > 0 && value <= most) return;
    add(where, fmt::format("must be more than 0 and at most {}", most));
  }
  /// Limits of a machine's drives, so that every move takes a finite time.
  void feed(const std::string& where, double mm_min) {
    constexpr double kSlowest = 0.001;
    within(where, mm_min, kSlowest, kLongestMm);
  }
  void point(const std::string& where, const Vec3& p, double most = kLongestMm) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      within(fmt::format("{}/{}", where, axis), p[axis], -most, most);
  }
  void direction(const std::string& where, const Vec3& d) {
    point(where, d);
    if (norm(d) < tolerance::kSamePoint) add(where, "a direction must not be zero");
  }

  Result<void> result() && {
    if (found_.empty()) return {};
    return listed(ErrorCode::SetupInvalid, std::move(found_));
  }

 private:
  std::vector<Error> found_;
};

void check_axis(Findings& findings, const std::string& at, Axis axis, const AxisSetup& setup) {
  const std::string unit = is_rotary(axis) ? "deg" : "mm";
  const double most = is_rotary(axis) ? kLargestDeg : kLongestMm;
  findings.within(at + "/min_" + unit, setup.min, -most, most);
  findings.within(at + "/max_" + unit, setup.max, -most, most);
  if (!(setup.min < setup.max))
    findings.conflict(at + "/max_" + unit, "the upper end must be above the lower end");
  if (!is_rotary(axis)) return;
  findings.within(at + "/hirth_grid_deg", setup.hirth_grid_deg, 0, 180);
  findings.point(at + "/center_mm", setup.centre);
  findings.direction(at + "/direction", setup.direction);
  findings.point(at + "/center_error_mm", setup.centre_error, 100);
  findings.point(at + "/tilt_error_deg", setup.tilt_error_deg, 45);
  findings.within(at + "/zero_error_deg", setup.zero_error_deg, -45, 45);
  findings.within(at + "/backlash_deg", setup.backlash_deg, 0, 10);
  findings.within(at + "/scatter_um", setup.scatter_um, 0, 1e6);
}

void check_start(Findings& findings, const MachineSetup& setup) {
  for (const Axis axis : kAllAxes) {
    if (!setup.start[axis]) continue;
    const std::string at = fmt::format("/machine/start_mm/{}", name(axis));
    const auto& known = setup.axes[index(axis)];
    if (!known) {
      findings.conflict(at, fmt::format("the machine has no axis {}", name(axis)));
    } else {
      findings.within(at, *setup.start[axis], known->min, known->max);
    }
  }
}

template <class Rows, class NumberOf>
void check_numbers(Findings& findings, const std::string& at, const Rows& rows, int least,
                   const NumberOf& number_of) {
  std::set<int> seen;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int number = number_of(rows[k]);
    const std::string where = fmt::format("{}/{}/number", at, k);
    findings.within(where, number, least, 65535);
    if (!seen.insert(number).second)
      findings.conflict(where, fmt::format("number {} is repeated", number));
  }
}

constexpr double kLongestToolMm = 10000;

void check_lathe_tool(Findings& findings, const std::string& at, const Tool& row) {
  const LatheTool& lathe = *row.lathe;
  findings.within(at + "/lathe/zl_mm", lathe.zl, 0, kLongestToolMm);
  findings.within(at + "/lathe/xl_mm", lathe.xl, -kLongestToolMm, kLongestToolMm);
  findings.within(at + "/lathe/dzl_mm", lathe.dzl, -1000, 1000);
  findings.within(at + "/lathe/dxl_mm", lathe.dxl, -1000, 1000);
  findings.within(at + "/lathe/rs_mm", lathe.rs, 0, 1000);
  findings.within(at + "/lathe/to", lathe.orientation, 0, 9);
  findings.within(at + "/lathe/ori_deg", lathe.ori, -360, 360);
  if (row.l != 0 || row.r != 0 || row.dl != 0 || row.dr != 0) {
    findings.conflict(at + "/lathe",
                      "a lathe tool has ZL, XL, DZL and DXL in place of L, R, DL and DR");
  }
  if (row.is_probe()) findings.conflict(at + "/lathe", "a touch probe is no lathe tool");
}

void check_tools(Findings& findings, const MachineSetup& setup) {
  check_numbers(findings, "/machine/tools", setup.tools, 1,
                [](const ToolSetup& t) { return t.row.number; });
  for (std::size_t k = 0; k < setup.tools.size(); ++k) {
    const auto& [row, length, radius, xl] = setup.tools[k];
    const std::string at = fmt::format("/machine/tools/{}", k);
    findings.within(at + "/length_mm", row.l, 0, 10000);
    findings.within(at + "/radius_mm", row.r, 0, 1000);
    findings.point(at + "/delta_mm", {row.dl, row.dr, row.dr2}, 1000);
    findings.within(at + "/actual_length_mm", length.value_or(0), 0, 10000);
    findings.within(at + "/actual_radius_mm", radius.value_or(0), 0, 1000);
    findings.within(at + "/length_offset_mm", row.l_offset, -1000, 1000);
    findings.within(at + "/radius_offset_mm", row.r_offset, -1000, 1000);
    if (row.lathe) check_lathe_tool(findings, at, row);
    if (row.lathe && radius)
      findings.conflict(at + "/actual_radius_mm", "a lathe tool has actual_xl_mm in its place");
    if (xl) {
      findings.within(at + "/actual_xl_mm", *xl, -kLongestToolMm, kLongestToolMm);
      if (!row.lathe) findings.conflict(at + "/actual_xl_mm", "only a lathe tool has XL");
    }
    if (!row.is_probe()) continue;
    const auto same = [&row = row](const ProbeSetup& p) { return p.row.number == row.probe; };
    if (std::ranges::none_of(setup.probes, same))
      findings.conflict(at + "/probe", fmt::format("probe not found: {}", row.probe));
    constexpr double kSmallestBall = 0.01;
    if (radius.value_or(row.r + row.dr) < kSmallestBall) {
      findings.add(at + "/radius_mm",
                   fmt::format("the ball of a probe must have at least {} mm", kSmallestBall));
    }
  }
}

void check_probes(Findings& findings, const MachineSetup& setup) {
  check_numbers(findings, "/machine/probes", setup.probes, 1,
                [](const ProbeSetup& p) { return p.row.number; });
  for (std::size_t k = 0; k < setup.probes.size(); ++k) {
    const auto& [row, repeatability, pretravel, offset] = setup.probes[k];
    const std::string at = fmt::format("/machine/probes/{}", k);
    findings.within(at + "/set_up_mm", row.set_up, 0, 1000);
    findings.positive(at + "/dist_mm", row.distance, 10000);
    findings.feed(at + "/feed_mm_min", row.feed);
    findings.feed(at + "/fmax_mm_min", row.rapid);
    findings.within(at + "/cal_of1_mm", row.cal_of1, -10, 10);
    findings.within(at + "/cal_of2_mm", row.cal_of2, -10, 10);
    if (row.uncertainty_um) findings.within(at + "/uncertainty_um", *row.uncertainty_um, 1e-3, 1e4);
    findings.within(at + "/repeatability_um", repeatability, 0, 1e4);
    findings.within(at + "/pretravel_um", pretravel, 0, 1e4);
    findings.within(at + "/center_offset_mm/0", offset[0], -10, 10);
    findings.within(at + "/center_offset_mm/1", offset[1], -10, 10);
  }
}

void check_presets(Findings& findings, const MachineSetup& setup) {
  check_numbers(findings, "/machine/presets", setup.presets, 0,
                [](const Preset& p) { return p.number; });
  for (std::size_t k = 0; k < setup.presets.size(); ++k) {
    const PresetFrame& frame = setup.presets[k].frame;
    const std::string at = fmt::format("/machine/presets/{}", k);
    findings.within(at + "/x_mm", frame.origin.x, -kLongestMm, kLongestMm);
    findings.within(at + "/y_mm", frame.origin.y, -kLongestMm, kLongestMm);
    findings.within(at + "/z_mm", frame.origin.z, -kLongestMm, kLongestMm);
    findings.point(at + "/rotation_deg", frame.basic_rotation_deg, 360);
    findings.point(at + "/offsets_deg", frame.rotary_offsets_deg, kLargestDeg);
  }
  if (setup.active_preset != 0 && std::ranges::find(setup.presets, setup.active_preset,
                                                    &Preset::number) == setup.presets.end()) {
    findings.conflict("/machine/active_preset",
                      fmt::format("preset not found: {}", setup.active_preset));
  }
}

/// Checks one feature at its pointer.
struct CheckFeature {
  Findings& findings;
  const std::string at;

  void operator()(const Block& block) const {
    findings.point(at + "/min_mm", block.min);
    findings.point(at + "/max_mm", block.max);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (block.min[axis] < block.max[axis]) continue;
      findings.conflict(fmt::format("{}/max_mm/{}", at, axis),
                        "the upper corner must be above the lower corner");
    }
  }

  void operator()(const Bore& bore) const {
    upright(bore.centre, bore.top, bore.diameter);
    findings.positive(at + "/depth_mm", bore.depth);
    findings.within(at + "/lobes", bore.lobes, 0, 1000);
    findings.within(at + "/lobe_phase_deg", bore.lobe_phase_deg, -360, 360);
    // Half the diameter changes by at most half the depth: steeper is no wall to probe.
    findings.within(at + "/taper_um_per_mm", bore.taper_um_per_mm, -1000, 1000);
    findings.within(at + "/tilt_deg/0", bore.tilt_deg[0], -45, 45);
    findings.within(at + "/tilt_deg/1", bore.tilt_deg[1], -45, 45);
    if (!(bore.diameter > 0)) return;
    const double amplitude = std::abs(bore.lobe_amplitude_um) / 1000;
    const double narrowest =
        bore.diameter / 2 + std::min(bore.taper_um_per_mm, 0.0) / 2000 * bore.depth;
    if (!(amplitude <= bore.diameter / 4)) {
      findings.add(at + "/lobe_amplitude_um", "must be at most a quarter of the diameter");
    } else if (narrowest - amplitude <= 0) {
      findings.conflict(at + "/taper_um_per_mm", "the bore must not close before its depth");
    }
  }

  void operator()(const Boss& boss) const {
    upright(boss.centre, boss.top, boss.diameter);
    findings.positive(at + "/height_mm", boss.height);
  }

  void operator()(const Plane& plane) const {
    findings.point(at + "/point_mm", plane.point);
    findings.direction(at + "/normal", plane.normal);
  }

  void operator()(const Sphere& sphere) const {
    findings.point(at + "/center_mm", sphere.centre);
    findings.positive(at + "/diameter_mm", sphere.diameter);
  }

  void operator()(const Mesh& mesh) const {
    findings.point(at + "/origin_mm", mesh.origin);
    findings.point(at + "/spatial_angles_deg", mesh.spatial_angles_deg, 360);
  }

  void operator()(const Surface& surface) const {
    std::set<std::pair<long long, long long>> places;
    for (std::size_t k = 0; k < surface.points.size(); ++k) {
      const Vec3& p = surface.points[k];
      const std::string where = fmt::format("{}/points_mm/{}", at, k);
      findings.point(where, p);
      constexpr double kNanometres = 1e6;
      if (is_finite(p) && norm(p) < 2 * kLongestMm &&
          !places.insert({std::llround(p.x * kNanometres), std::llround(p.y * kNanometres)})
               .second) {
        findings.conflict(where, "a surface must have one height at each X and Y");
      }
    }
    if (places.size() == surface.points.size() && delaunay(surface.points).triangles.empty())
      findings.add(at + "/points_mm", "a surface needs three points that are not on one line");
  }

 private:
  void upright(const std::array<double, 2>& centre, double top, double diameter) const {
    findings.within(at + "/center_mm/0", centre[0], -kLongestMm, kLongestMm);
    findings.within(at + "/center_mm/1", centre[1], -kLongestMm, kLongestMm);
    findings.within(at + "/top_mm", top, -kLongestMm, kLongestMm);
    findings.positive(at + "/diameter_mm", diameter);
  }
};

void check_tool_touch_probe(Findings& findings, const ToolTouchProbeSetup& tt) {
  constexpr double kLargest = 1000;
  findings.point("/machine/tt/center_mm", tt.known.centre);
  findings.positive("/machine/tt/radius_mm", tt.known.radius, kLargest);
  findings.point("/machine/tt/actual_center_mm", tt.actual_centre.value_or(Vec3{}));
  findings.positive("/machine/tt/actual_radius_mm", tt.actual_radius.value_or(kLargest), kLargest);
  findings.within("/machine/tt/repeatability_um", tt.repeatability_um, 0, 1e4);
}

void check_kinematics_options(Findings& findings, const KinematicsOptions& options) {
  if (options.max_modification)
    findings.within("/machine/max_modification_mm", *options.max_modification, 0, kLongestMm);
  findings.within("/machine/max_calibration_ball_deviation_mm", options.max_ball_deviation, 0,
                  kLongestMm);
}

void check_standards(Findings& findings, const MachineSetup& setup) {
  if (const auto& ring = setup.calibration_ring) {
    const std::string at = "/machine/calibration_ring";
    CheckFeature{findings, at}(Boss{ring->centre, ring->top, ring->height, ring->diameter});
    if (!(ring->outside() > ring->diameter && ring->outside() <= kLongestMm))
      findings.conflict(at + "/outer_diameter_mm", "must be more than the diameter of the hole");
  }
  if (setup.calibration_stud)
    CheckFeature{findings, "/machine/calibration_stud"}(*setup.calibration_stud);
  if (const auto& sphere = setup.calibration_sphere) {
    findings.point("/machine/calibration_sphere/center_mm", sphere->centre);
    findings.positive("/machine/calibration_sphere/radius_mm", sphere->radius, 1000);
  }
}

}  // namespace

Result<void> validate(const Setup& setup) {
  Findings findings;
  const MachineSetup& machine = setup.machine;
  for (const Axis axis : kAllAxes) {
    const auto& known = machine.axes[index(axis)];
    const std::string at = fmt::format("/machine/axes/{}", name(axis));
    if (known) check_axis(findings, at, axis, *known);
    if (!known && !is_rotary(axis))
      findings.add(at, "a machine must have X, Y and Z", ErrorCode::FieldMissing);
  }
  check_start(findings, machine);
  findings.feed("/machine/rapid_mm_min", machine.rapid_mm_min);
  check_tools(findings, machine);
  check_probes(findings, machine);
  check_tool_touch_probe(findings, machine.tt);
  check_kinematics_options(findings, machine.kinematics_options);
  check_standards(findings, machine);
  check_presets(findings, machine);
  each_feature(setup, [&findings](const std::string& at, const Feature& feature) {
    std::visit(CheckFeature{findings, at}, feature);
  });
  return std::move(findings).result();
}

AxisSetup AxisSetup::of(Axis axis) {
  AxisSetup setup;
  setup.direction = unit_vector(axis);
  if (is_rotary(axis)) {
    setup.max = axis == Axis::C ? 360 : 120;
    setup.min = -setup.max;
  }
  return setup;
}

RotaryAxis AxisSetup::modelled(Axis axis) const {
  return {axis, mount, mount == AxisMount::Head ? Vec3{} : centre, direction};
}

RotaryAxis AxisSetup::built(Axis axis) const {
  RotaryAxis real = modelled(axis);
  real.centre = real.centre + centre_error;
  real.direction = Matrix3::spatial(tilt_error_deg) * real.direction;
  real.zero_deg = zero_error_deg;
  return real;
}

Position MachineSetup::start_position() const {
  Position position;
  for (const Axis axis : kAllAxes) {
    if (start[axis]) {
      position[axis] = *start[axis];
    } else if (axis == Axis::Z && axes[index(axis)]) {
      position[axis] = axes[index(axis)]->max;
    }
  }
  return position;
}

}  // namespace fitgauge::machine

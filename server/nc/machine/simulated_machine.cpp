#include "nc/machine/simulated_machine.hpp"

#include "nc/machine/solid.hpp"

namespace fitgauge::machine {
namespace {

constexpr double kMillimetresPerMicrometre = 1e-3;

Kinematics as_built(const MachineSetup& setup) {
  std::vector<RotaryAxis> axes;
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const auto& known = setup.axes[index(axis)];
    if (known) axes.push_back(known->built(axis));
  }
  return Kinematics(std::move(axes));
}

/// Objects on the table: the workpiece and the calibration standards. Only the ring has a hole,
/// so it comes first.
std::vector<Feature> on_table(const Setup& setup) {
  std::vector<Feature> features;
  if (const auto& ring = setup.machine.calibration_ring) {
    features.emplace_back(Boss{ring->centre, ring->top, ring->height, ring->outside()});
    Bore hole;
    hole.centre = ring->centre;
    hole.top = ring->top;
    hole.depth = ring->height;
    hole.diameter = ring->diameter;
    features.emplace_back(hole);
  }
  features.insert(features.end(), setup.features.begin(), setup.features.end());
  if (setup.machine.calibration_stud) features.emplace_back(*setup.machine.calibration_stud);
  if (const auto& sphere = setup.machine.calibration_sphere)
    features.emplace_back(Sphere{sphere->centre, 2 * sphere->radius});
  return features;
}

/// A cutter against the tool touch probe is a cylinder against a contact plate: the centre of its
/// tip against the plate grown by the cylinder's radius, and down, since the flank touches it with
/// the tip below.
std::vector<Feature> around_plate(const ToolTouchProbeSetup& tt, double tool_radius) {
  const Vec3 top = tt.actual_centre.value_or(tt.known.centre);
  const double half = tt.actual_radius.value_or(tt.known.radius);
  const double grown = half + tool_radius;
  constexpr double kDown = 1e4;  // mm
  if (tt.known.shape == ContactPlate::Disc) return {Boss{{top.x, top.y}, top.z, kDown, 2 * grown}};
  const auto block = [&](double x, double y) {
    return Block{{top.x - x, top.y - y, top.z - kDown}, {top.x + x, top.y + y, top.z}};
  };
  std::vector<Feature> features{block(grown, half), block(half, grown)};
  if (tool_radius == 0) return features;
  for (const double x : {top.x - half, top.x + half}) {
    for (const double y : {top.y - half, top.y + half})
      features.emplace_back(Boss{{x, y}, top.z, kDown, 2 * tool_radius});
  }
  return features;
}

}  // namespace

SimulatedAxes::SimulatedAxes(const Setup& setup)
    : setup_(setup.machine),
      workpiece_(on_table(setup)),
      fixtures_(setup.fixtures),
      kinematics_(as_built(setup.machine)),
      nose_(setup.machine.start_position()),
      rest_{},
      random_(setup.seed) {
  for (const Feature& each : setup.features) {
    if (const auto* bore = std::get_if<Bore>(&each))
      round_.push_back({bore->centre, {false, bore->diameter, {}}});
    if (const auto* boss = std::get_if<Boss>(&each))
      round_.push_back({boss->centre, {true, boss->diameter, {}}});
    if (const auto* block = std::get_if<Block>(&each)) blocks_.push_back(*block);
  }
}

std::vector<PartFeature> SimulatedAxes::part_features(const Vec3& at) const {
  const Vec3 place = real_table(nose_.rotary).inverse().point(at);
  std::vector<PartFeature> found;
  for (const RoundPlace& each : round_) {
    const double away = std::hypot(place.x - each.centre[0], place.y - each.centre[1]);
    if (away < each.feature.diameter / 4) found.push_back(each.feature);
  }
  if (const auto rectangle = found.empty() ? rectangle_at(place) : std::nullopt)
    found.push_back(*rectangle);
  return found;
}

/// The block around a place, or the room between blocks.
std::optional<PartFeature> SimulatedAxes::rectangle_at(const Vec3& place) const {
  const auto spans = [&](const Block& block, std::size_t axis) {
    return block.min[axis] < place[axis] && place[axis] < block.max[axis];
  };
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 2> above{kFar, kFar};
  std::array<double, 2> below{kFar, kFar};
  for (const Block& block : blocks_) {
    if (!spans(block, 2)) continue;
    const Vec3 size = block.max - block.min;
    if (spans(block, 0) && spans(block, 1)) return PartFeature{true, 0, {size.x, size.y}};
    for (const std::size_t axis : {0U, 1U}) {
      if (!spans(block, 1 - axis)) continue;
      const bool is_above = block.min[axis] >= place[axis];
      double& nearest = is_above ? above[axis] : below[axis];
      nearest = std::min(nearest,
                         is_above ? block.min[axis] - place[axis] : place[axis] - block.max[axis]);
    }
  }
  PartFeature room;
  for (const std::size_t axis : {0U, 1U})
    if (above[axis] + below[axis] < kFar) room.length[axis] = above[axis] + below[axis];
  return room.length == std::array{0.0, 0.0} ? std::nullopt : std::optional(room);
}

void SimulatedAxes::turn(const Vec3& rotary) {
  const Vec3 turn = rotary - nose_.rotary;
  for (std::size_t letter = 0; letter < 3; ++letter) {
    const auto& axis = setup_.axes[letter + 3];
    if (!axis || turn[letter] == 0) continue;
    slack_deg_[letter] = turn[letter] > 0 ? 0 : axis->backlash_deg;
    if (axis->scatter_um == 0) continue;
    const double scatter = axis->scatter_um * kMillimetresPerMicrometre;
    for (std::size_t k = 0; k < 3; ++k) rest_[letter][k] = scatter * random_.normal();
  }
}

SimulatedAxes::RealTool SimulatedAxes::real_tool(const SpindleTool& known) const {
  RealTool real{known.axis, known.length, known.radius, {}, nullptr, false};
  const auto tool = std::ranges::find(setup_.tools, known.number,
                                      [](const ToolSetup& t) { return t.row.number; });
  if (tool == setup_.tools.end()) return real;
  if (const auto& lathe = tool->row.lathe) {
    const double xl = tool->actual_xl.value_or(lathe->xl + lathe->dxl);
    const double zl = tool->actual_length.value_or(lathe->zl + lathe->dzl);
    real.radius = lathe->rs;
    real.length = zl + lathe->below_tip();
    real.offset = turned_offset({xl - lathe->tip_x() * lathe->rs, 0}, known.axis,
                                known.spindle_deg - lathe->ori);
    real.is_lathe = true;
    return real;
  }
  real.length = tool->actual_length.value_or(tool->row.l + tool->row.dl);
  real.radius = tool->actual_radius.value_or(tool->row.r + tool->row.dr);
  const auto probe = std::ranges::find(setup_.probes, tool->row.probe,
                                       [](const ProbeSetup& p) { return p.row.number; });
  if (probe == setup_.probes.end()) return real;
  real.probe = &*probe;
  real.offset = turned_offset(probe->centre_offset, known.axis, known.spindle_deg);
  return real;
}

Transform SimulatedAxes::real_table(const Vec3& rotary) const {
  return kinematics_.table(rotary + slack_deg_, rest_);
}

Vec3 SimulatedAxes::real_tool_point(const Position& nose, const RealTool& tool,
                                    double length) const {
  return nose.linear + kinematics_.tool_vector(nose.rotary + slack_deg_, tool.axis, length, rest_);
}

Vec3 SimulatedAxes::ball_on_table(const Position& nose, const RealTool& tool) const {
  const Vec3 centre = real_tool_point(nose, tool, tool.length - tool.radius) + tool.offset;
  return real_table(nose.rotary).inverse().point(centre);
}

MachineResult<double> SimulatedAxes::follow(const Path& path, const Motion& motion) {
  if (path.end.rotary != path.start.rotary) turn(path.end.rotary);
  const auto free = [&](const Workpiece& body) {
    const bool can_touch = !motion.is_retract && !body.is_empty();
    return can_touch ? free_part(body, path, real_tool(motion.tool), motion.allowance) : 1;
  };
  const double part = motion.tool.is_probe ? free(workpiece_) : 1;
  const bool is_cutter = !motion.tool.is_probe && motion.tool.number != 0;
  const bool is_harmful = is_cutter && (motion.feed.is_rapid || !motion.tool.turns);
  has_entered_part_ =
      is_harmful && (starts_free(path, motion.tool) ? free(workpiece_) < 1
                                                    : goes_on(path, motion) && !motion.is_retract);
  const double to_fixture = free(fixtures_);
  if (motion.allowance.found() != Allowance::Spent::Nothing)
    return make_fault(FaultKind::Interrupted);
  const double gone = std::min(part, to_fixture);
  nose_ = gone < 1 ? path.nose(gone) : path.end;
  if (to_fixture < part) return make_fault(FaultKind::FixtureCollision);
  return part;
}

bool SimulatedAxes::starts_free(const Path& path, const SpindleTool& known) const {
  const RealTool tool = real_tool(known);
  return workpiece_.clearance(ball_on_table(path.start, tool), tool.radius) > 0;
}

/// Whether a cutter that begins in the part is still in it one radius further, or at the end. Back
/// along its axis it leaves the part.
bool SimulatedAxes::goes_on(const Path& path, const Motion& motion) const {
  const RealTool tool = real_tool(motion.tool);
  const auto ball = [&](double part) {
    return ball_on_table(part < 1 ? path.nose(part) : path.end, tool);
  };
  const auto is_inside = [&](const Vec3& centre) {
    return workpiece_.clearance(centre, tool.radius) < -tolerance::kNanometre;
  };
  const Vec3 start = ball(0);
  const Vec3 way = ball(1) - start;
  const double length = norm(way);
  const Vec3 back = real_table(path.start.rotary)
                        .inverse()
                        .direction(kinematics_.tool_direction(path.start.rotary, tool.axis));
  const bool leaves = path.is_straight && dot(way, back) >= length * (1 - tolerance::kSquare);
  if (leaves || !is_inside(start)) return false;
  return is_inside(ball(path.is_straight && length > tool.radius ? tool.radius / length : 1));
}

/// The part of the path, 0 to 1, that the ball can go without touching.
double SimulatedAxes::free_part(const Workpiece& body, const Path& path, const RealTool& tool,
                                Allowance& allowance) const {
  const double radius = tool.radius - tolerance::kNanometre;

  if (path.is_straight) {
    const Vec3 start = ball_on_table(path.start, tool);
    const Vec3 way = ball_on_table(path.end, tool) - start;
    const double length = norm(way);
    if (length == 0) return 1;
    const auto touched = body.contact(start, way * (1 / length), radius, length, allowance);
    return touched ? std::min(*touched / length, 1 - 1e-15) : 1;
  }
  double lever = norm(path.start.linear) + path.nose_speed + tool.length + norm(tool.offset);
  for (const RotaryAxis& axis : kinematics_.axes()) lever += norm(axis.centre);
  const Vec3 turn = path.end.rotary - path.start.rotary;
  const double speed =
      path.nose_speed + radians(std::abs(turn.x) + std::abs(turn.y) + std::abs(turn.z)) * lever;
  if (speed == 0) return 1;
  const auto touched = first_zero(
      [&](double way) {
        return body.clearance(ball_on_table(path.nose(way / speed), tool), radius);
      },
      speed, least_step(radius), allowance);
  return touched ? std::min(*touched / speed, 1 - 1e-15) : 1;
}

MachineResult<Position> SimulatedAxes::probe(const Vec3& direction, double distance,
                                             const Motion& motion) {
  const RealTool tool = real_tool(motion.tool);
  touching_.reset();
  const auto way = motion.tool.is_probe
                       ? probe_contact(direction, distance, tool, motion.allowance)
                       : plate_contact(direction, distance, tool, motion.allowance);
  if (motion.allowance.found() != Allowance::Spent::Nothing)
    return make_fault(FaultKind::Interrupted);
  const bool is_missed = !way && way.error().kind == FaultKind::NoContact;
  if (way || is_missed) nose_.linear = nose_.linear + direction * (way ? *way : distance);
  if (!way) return way.error();
  return nose_;
}

MachineResult<double> SimulatedAxes::probe_contact(const Vec3& direction, double distance,
                                                   const RealTool& tool, Allowance& allowance) {
  const Vec3 start = ball_on_table(nose_, tool);
  if (workpiece_.clearance(start, tool.radius) < -tolerance::kNanometre)
    return make_fault(FaultKind::StylusDeflected);
  const Vec3 on_table = real_table(nose_.rotary).inverse().direction(direction);
  const auto touched = workpiece_.contact(start, on_table, tool.radius, distance, allowance);
  const double before = touched.value_or(distance);
  if (fixtures_.contact(start, on_table, tool.radius, before, allowance).value_or(before) <
      before) {
    return make_fault(FaultKind::FixtureCollision, "it blocks the probing move");
  }
  if (!touched) return make_fault(FaultKind::NoContact);
  touching_ = start + on_table * *touched;
  table_at_contact_ = real_table(nose_.rotary);
  if (tool.probe == nullptr) return triggered(*touched, 0, distance);
  const double way = *touched + tool.probe->pretravel_um * kMillimetresPerMicrometre;
  return triggered(way, tool.probe->repeatability_um, distance);
}

/// The way after which a probe reports its contact, if that is within the distance.
MachineResult<double> SimulatedAxes::triggered(double way, double repeatability_um,
                                               double distance) {
  if (repeatability_um != 0) way += repeatability_um * kMillimetresPerMicrometre * random_.normal();
  if (way > distance) return make_fault(FaultKind::NoContact);
  return std::max(way, 0.0);
}

std::optional<Vec3> SimulatedAxes::contact_normal() const {
  if (!touching_) return std::nullopt;
  const auto normal = workpiece_.normal(*touching_);
  if (!normal) return std::nullopt;
  return unit(table_at_contact_.direction(*normal));
}

MachineResult<double> SimulatedAxes::plate_contact(const Vec3& direction, double distance,
                                                   const RealTool& tool, Allowance& allowance) {
  const double edge = tool.is_lathe ? tool.radius : 0;
  const Workpiece plate(around_plate(setup_.tt, tool.is_lathe ? 0 : tool.radius));
  const Vec3 tip = real_tool_point(nose_, tool, tool.length - edge) + tool.offset;
  if (plate.clearance(tip, edge) < -tolerance::kNanometre)
    return make_fault(FaultKind::StylusDeflected);
  const auto touched = plate.contact(tip, direction, edge, distance, allowance);
  if (!touched) return make_fault(FaultKind::NoContact);
  return triggered(*touched, setup_.tt.repeatability_um, distance);
}

}  // namespace fitgauge::machine

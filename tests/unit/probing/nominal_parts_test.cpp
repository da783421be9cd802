#include "nominal_parts.hpp"

#include <algorithm>
#include <set>

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Frames;
using machine::Vec3;

/// A feature of the drawing where it lies with `frames` active.
class Placed {
 public:
  explicit Placed(const Frames& frames) : frames_(frames), scale_(frames.scaling().factor.x) {}

  machine::Feature operator()(const machine::Block& block) const {
    const Vec3 a = frames_.to_machine(block.min);
    const Vec3 b = frames_.to_machine(block.max);
    return machine::Block{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                          {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
  }
  machine::Feature operator()(machine::Bore bore) const {
    place(bore);
    bore.depth *= scale_;
    return bore;
  }
  machine::Feature operator()(machine::Boss boss) const {
    place(boss);
    boss.height *= scale_;
    return boss;
  }
  machine::Feature operator()(const machine::Plane& plane) const {
    return machine::Plane{frames_.to_machine(plane.point),
                          frames_.direction_to_machine(plane.normal)};
  }
  template <class Other>
  machine::Feature operator()(const Other& other) const {
    return other;
  }

 private:
  template <class Round>
  void place(Round& round) const {
    const Vec3 top = frames_.to_machine({round.centre[0], round.centre[1], round.top});
    round.centre = {top.x, top.y};
    round.top = top.z;
    round.diameter *= scale_;
  }

  const Frames& frames_;
  double scale_;
};

/// Runs the case with its part placed in the frames, and compares the results.
void check_in(const NominalCase& c, const Frames& frames) {
  machine::Setup setup;
  setup.machine.axes[index(Axis::C)] = machine::AxisSetup::of(Axis::C);
  for (const machine::Feature& feature : c.part) {
    setup.features.push_back(std::visit(Placed(frames), feature));
  }
  ProbingBench bench(setup);
  REQUIRE(bench.machine.set_frames(frames).has_value());
  machine::AxisWords above = machine::AxisWords::linear(c.start);
  above[Axis::Z].reset();
  REQUIRE(bench.machine.move({above, {}}).has_value());
  REQUIRE(bench.machine.move({machine::AxisWords::linear(c.start), {}}).has_value());

  CAPTURE(bench.fault.text);
  CHECK(bench.run(c.cycle, c.block) == 0);
  for (const auto& [q, nominal] : c.results) {
    CAPTURE(q);
    REQUIRE(bench.host.q.contains(q));
    CHECK(std::abs(bench.host.q[q] - nominal) < 1e-9);
  }
  if (c.touched) {
    const auto& [axis, coordinate] = *c.touched;
    CHECK(std::abs(bench.host.touches.back().surface[axis] - coordinate) < 1e-9);
  }
  CHECK(std::abs(bench.machine.state().frames.preset().basic_rotation_deg.z) < 1e-9);
}

/// A plate turned by other than right angles is drawn as a box too: its middle stays where it was.
std::vector<Frames> frames_for(const NominalCase& c) {
  std::vector<Frames> all(3);
  all[0].set_datum_shift({{-50, 20, -10}, {}});
  all[1].set_datum_shift({{30, -40, 5}, {}});
  all[1].set_rotation({90, Axis::Z});
  all[2].set_rotation({-90, Axis::Z});
  all[2].set_scaling({{0.8, 0.8, 0.8}, {}});
  if (!c.only_right_angles) {
    all.emplace_back().set_rotation({33, Axis::Z});
    all.back().set_scaling({{0.9, 0.9, 0.9}, {}});
  }
  if (c.cycle != 444) return all;  // which works neither mirrored nor scaled
  for (Frames& frames : all) frames.set_scaling({});
  return all;
}

}  // namespace

TEST_CASE("every cycle that touches the workpiece has a part equal to its drawing") {
  std::set<int> covered;
  for (const NominalCase& c : nominal_cases()) covered.insert(c.cycle);
  for (const TouchProbeCycle* cycle : cycles()) {
    const CycleDescriptor& descriptor = cycle->descriptor;
    const bool touches = descriptor.kind == CycleKind::Measuring ||
                         descriptor.kind == CycleKind::Preset ||
                         descriptor.kind == CycleKind::Alignment;
    if (!touches || descriptor.number == 247 || descriptor.number == 404) continue;  // no motion
    CAPTURE(descriptor.number);
    CHECK(covered.contains(descriptor.number));
  }
}

TEST_CASE("a part equal to its drawing gives the nominal values in every cycle") {
  for (const NominalCase& c : nominal_cases()) {
    CAPTURE(c.cycle);
    check_in(c, {});
  }
}

TEST_CASE("every measuring cycle gives the same results in a shifted, rotated or scaled frame") {
  for (const NominalCase& c : nominal_cases()) {
    const TouchProbeCycle* cycle = find_cycle(CycleFamily::TchProbe, c.cycle);
    if (cycle->descriptor.kind != CycleKind::Measuring) continue;
    CAPTURE(c.cycle);
    for (const Frames& frames : frames_for(c)) {
      CAPTURE(frames.rotation().angle_deg);
      check_in(c, frames);
    }
  }
}

}  // namespace fitgauge::probing

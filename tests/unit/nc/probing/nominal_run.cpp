#include "nominal_parts.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Frames;
using machine::Vec3;

/// A feature of the drawing where it lies with `frames` active.
class Placed {
 public:
  Placed(const Frames& frames, const Vec3& displaced)
      : frames_(frames), displaced_(displaced), scale_(frames.scaling().factor.x) {}

  machine::Feature operator()(const machine::Block& block) const {
    const Vec3 a = at(block.min);
    const Vec3 b = at(block.max);
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
    return machine::Plane{at(plane.point), frames_.direction_to_machine(plane.normal)};
  }
  machine::Feature operator()(const machine::Sphere& sphere) const {
    return machine::Sphere{at(sphere.centre), sphere.diameter * scale_};
  }
  template <class Other>
  machine::Feature operator()(const Other& other) const {
    return other;
  }

 private:
  Vec3 at(const Vec3& point) const { return frames_.to_machine(point + displaced_); }

  template <class Round>
  void place(Round& round) const {
    const Vec3 top = at({round.centre[0], round.centre[1], round.top});
    round.centre = {top.x, top.y};
    round.top = top.z;
    round.diameter *= scale_;
  }

  const Frames& frames_;
  Vec3 displaced_;
  double scale_;
};

/// The measured centre (Q151, Q152) as the preset in row 9 reads it.
void add_datum(ProbingBench& bench, const Frames& frames, std::vector<double>& values) {
  const machine::Preset* row = bench.machine.state().presets.find(9);
  if (row == nullptr || !bench.host.q.contains(152)) return;
  Frames written;
  written.set_preset(row->frame);
  const Vec3 point =
      written.from_machine(frames.to_machine({bench.host.q[151], bench.host.q[152], 0}));
  values.insert(values.end(), {point.x, point.y});
}

}  // namespace

Outcome run_in(const NominalCase& c, const Frames& frames, const Vec3& displaced) {
  machine::Setup setup;
  setup.machine.axes[index(Axis::C)] = machine::AxisSetup::of(Axis::C);
  for (const machine::Feature& feature : c.part) {
    setup.features.push_back(std::visit(Placed(frames, displaced), feature));
  }
  ProbingBench bench(setup);
  REQUIRE(bench.machine.set_frames(frames).has_value());
  machine::AxisWords above = machine::AxisWords::linear(c.start);
  above[Axis::Z].reset();
  REQUIRE(bench.machine.move({above, {}}).has_value());
  REQUIRE(bench.machine.move({machine::AxisWords::linear(c.start), {}}).has_value());

  Outcome outcome{.error = bench.run(c.cycle, c.block), .values = {}, .stored = {}};
  CAPTURE(bench.fault.text);
  if (outcome.error != 0) {
    CHECK(bench.host.touches.empty());
    CHECK(bench.host.files.empty());
    return outcome;
  }
  for (const auto& result : c.results) {
    REQUIRE(bench.host.q.contains(result.first));
    outcome.values.push_back(bench.host.q[result.first]);
  }
  if (c.touched) outcome.values.push_back(bench.host.touches.back().surface[c.touched->first]);
  add_datum(bench, frames, outcome.stored);
  const double turned = bench.machine.state().frames.preset().basic_rotation_deg.z;
  const bool aligns =
      find_cycle(CycleFamily::TchProbe, c.cycle)->descriptor.kind == CycleKind::Alignment;
  const double part = aligns && c.results.empty() ? frames.rotation().angle_deg : 0;
  outcome.values.push_back(std::remainder(turned - part, 180));
  return outcome;
}

}  // namespace fitgauge::probing

#include "nc/machine/random.hpp"
#include "probing_bench.hpp"
#include "support/deep.hpp"

/// Datums set in random planes on random machines: the point then reads its target there. Where it
/// lies follows from rotations that are written down here once more.
namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::AxisWords;
using machine::CoordinateSystem;
using machine::Vec3;
using Rows = std::array<Vec3, 3>;

Vec3 turned_about(std::size_t axis, double degrees, Vec3 v) {
  const double angle = degrees * std::acos(-1.0) / 180;
  const std::size_t a = (axis + 1) % 3;
  const std::size_t b = (axis + 2) % 3;
  const double first = v[a] * std::cos(angle) - v[b] * std::sin(angle);
  v[b] = v[a] * std::sin(angle) + v[b] * std::cos(angle);
  v[a] = first;
  return v;
}

/// Spatial angles: about the fixed X, then the fixed Y, then the fixed Z.
Vec3 turned_by(const Vec3& angles, Vec3 v) {
  for (std::size_t axis = 0; axis < 3; ++axis) v = turned_about(axis, angles[axis], v);
  return v;
}

Vec3 turned_back(const Vec3& angles, Vec3 v) {
  for (std::size_t axis = 3; axis-- > 0;) v = turned_about(axis, -angles[axis], v);
  return v;
}

std::uint64_t tilted_seeds() { return static_cast<std::uint64_t>(rounds(100, 1'000)); }

/// A preset with a basic rotation in space, a plane in it, shifts before and behind it, and a
/// machine that can stand square to the plane.
struct Place {
  explicit Place(std::uint64_t seed) : random(seed) {
    preset = {.origin = within(40),
              .basic_rotation_deg = seed % 5 < 2 ? Vec3{} : within(9),
              .rotary_offsets_deg = {}};
    plane = {.spatial_deg = within(14), .origin = within(20)};
    shift = within(30);
    target = within(25);
    foot = within(30);
    const std::array<std::array<Axis, 2>, 3> kinds{
        {{Axis::A, Axis::C}, {Axis::B, Axis::C}, {Axis::A, Axis::B}}};
    axes = kinds[seed % 3];
    on_head = (seed / 3) % 3;
    stored = seed % 2 == 0;
  }

  Vec3 within(double limit) {
    const auto number = [&] { return limit * std::remainder(random.normal() * 7, 2.0); };
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  /// Along the plane's Z, from the workpiece, with all axes at 0.
  Vec3 normal() const {
    return turned_by(preset.basic_rotation_deg, turned_by(plane.spatial_deg, {0, 0, 1}));
  }

  /// What a point of the table reads in the plane of that preset row, without shift.
  Vec3 reading(const machine::PresetFrame& row, const Vec3& point) const {
    return turned_back(plane.spatial_deg, turned_back(row.basic_rotation_deg, point - row.origin));
  }

  bool is_turned() const { return preset.basic_rotation_deg != Vec3{}; }

  machine::Random random;
  machine::PresetFrame preset;
  machine::TiltedPlane plane;
  Vec3 shift;
  Vec3 target;
  Vec3 foot;  ///< of what is touched, on the table
  std::array<Axis, 2> axes{};
  std::uint64_t on_head = 0;
  Vec3 start{0, 0, 500};  ///< of the nose
  Vec3 above{0, 0, 60};   ///< of the tip before the cycle, from the foot
  bool stored = false;    ///< in row 7, which 247 activates; else row 0 at once
};

class PlaneBench : public ProbingBench {
 public:
  PlaneBench(const Place& place, std::vector<machine::Feature> part)
      : ProbingBench(setup(place, std::move(part))), place_(place) {
    machine::Frames frames;
    frames.set_preset(place.preset);
    frames.set_plane(place.plane);
    frames.set_datum_shift({place.shift, {}});
    REQUIRE(machine.set_frames(frames).has_value());
    const auto positions = machine.state().kinematics.orientations(place.normal(), {}, Axis::Z);
    REQUIRE_FALSE(positions.empty());
    AxisWords words;
    for (const Axis axis : place.axes) words[axis] = positions.front()[index(axis) - 3];
    REQUIRE(machine.move({words, {}, CoordinateSystem::Machine}).has_value());
    nominal = input(place.foot);
    REQUIRE(machine.move({AxisWords::linear(nominal + place.above), {}}).has_value());
  }

  Vec3 input(const Vec3& on_table) const {
    const machine::MachineState& state = machine.state();
    return state.frames.from_machine(state.kinematics.table(state.nose.rotary).point(on_table));
  }

  /// Sets the datum and makes it count.
  void set_datum(int cycle, const Values& block) {
    const Values row{{305, place_.stored ? 7.0 : 0.0}, {303, 1.0}};
    const int error = run(cycle, with(block, row));
    CAPTURE(fault.text);
    REQUIRE(error == 0);
    if (place_.stored) REQUIRE(run(247, {{339, 7.0}}, CycleFamily::CyclDef) == 0);
  }

  const machine::PresetFrame& active() const { return machine.state().frames.preset(); }

  Vec3 nominal;  ///< the foot in input coordinates

 private:
  static machine::Setup setup(const Place& place, std::vector<machine::Feature> part) {
    machine::Setup setup{.machine = {}, .features = std::move(part)};
    for (std::size_t k = 0; k < 2; ++k) {
      auto& axis =
          setup.machine.axes[index(place.axes[k])].emplace(machine::AxisSetup::of(place.axes[k]));
      // Table and table, head and table, head and head (the tool's side is never C).
      const bool head = place.on_head == 2 ? place.axes[k] != Axis::C : k + 1 == place.on_head;
      if (head && place.axes[k] != Axis::C) {
        axis.mount = machine::AxisMount::Head;
        axis.centre = {0, 0, 30};
      }
    }
    setup.machine.start = AxisWords::linear(place.start);
    setup.machine.presets.front().frame = place.preset;
    return setup;
  }

  const Place& place_;
};

}  // namespace

TEST_CASE("417 in any plane: the point reads its target there") {
  for (std::uint64_t seed = 1; seed <= tilted_seeds(); ++seed) {
    CAPTURE(seed);
    const Place place(seed);
    PlaneBench bench(place, {machine::Plane{place.foot, place.normal()}});
    const Vec3 at = bench.nominal;
    bench.set_datum(417, {{263, at.x},
                          {264, at.y},
                          {294, at.z},
                          {320, 0.0},
                          {260, at.z + 40},
                          {333, place.target.z}});
    CHECK(std::abs(place.reading(bench.active(), place.foot).z - place.target.z) < 1e-8);
    // What it is for the next cycle; 427 resets a basic rotation, 417 does not.
    const Vec3 now = bench.input(place.foot);
    const Values again{{263, now.x}, {264, now.y}, {320, 0.0}, {260, now.z + 40}};
    REQUIRE(bench.run(417, with(again, {{294, now.z}, {305, 9.0}, {303, 1.0}})) == 0);
    CHECK(std::abs(bench.host.q[160] - place.target.z) < 1.5e-6);
    if (place.is_turned()) continue;
    REQUIRE(bench.run(427, with(again, {{261, now.z}, {272, 3.0}, {267, -1.0}})) == 0);
    CHECK(std::abs(bench.host.q[160] - place.target.z) < 1.5e-6);
  }
}

TEST_CASE("412 in any plane: the centre reads its target there, whatever the height") {
  for (std::uint64_t seed = 1; seed <= tilted_seeds(); ++seed) {
    CAPTURE(seed);
    Place place(seed);
    const Vec3 normal = place.normal();
    // A turn around X, then one around Y, that bring Z into the normal.
    const double around_x = machine::degrees(std::asin(-normal.y));
    const double around_y = machine::degrees(std::atan2(normal.x, normal.z));
    const machine::Bore bore{.centre = {place.foot.x, place.foot.y},
                             .top = place.foot.z,
                             .depth = 60,
                             .diameter = 30,
                             .tilt_deg = {around_x, around_y}};
    PlaneBench bench(place, {machine::Block{{-400, -400, -300}, {400, 400, place.foot.z}}, bore});
    const Vec3 at = bench.nominal + Vec3{0.3, -0.2, 0};
    const double height = at.z - 22 - static_cast<double>(seed % 9);
    bench.set_datum(412, with(values("262=29.5 325=10 247=90 320=0"), {{321, at.x},
                                                                       {322, at.y},
                                                                       {261, height},
                                                                       {260, at.z + 40},
                                                                       {331, place.target.x},
                                                                       {332, place.target.y}}));
    const Vec3 reads = place.reading(bench.active(), place.foot);
    CHECK(std::abs(reads.x - place.target.x) < 2e-8);
    CHECK(std::abs(reads.y - place.target.y) < 2e-8);
    const Vec3 now = bench.input(place.foot);
    const Values again{{262, 30.0},       {325, 0.0}, {247, 90.0},
                       {261, now.z - 25}, {320, 0.0}, {260, now.z + 40}};
    const auto check_centre = [&] {
      CHECK(std::abs(bench.host.q[151] - place.target.x) < 1.5e-6);
      CHECK(std::abs(bench.host.q[152] - place.target.y) < 1.5e-6);
    };
    REQUIRE(bench.run(412, with(again, with(values("305=9 303=1"),
                                            {{321, place.target.x}, {322, place.target.y}}))) == 0);
    check_centre();
    if (place.is_turned()) continue;
    REQUIRE(bench.run(421, with(again, with(values("275=0 276=0 279=0 280=0"),
                                            {{273, place.target.x}, {274, place.target.y}}))) == 0);
    check_centre();
  }
}

TEST_CASE("415 with Q304 turns a part around its own normal, in space too") {
  // The corner of a part that lies turned by 2 degrees in a preset turned by 30 around X.
  for (const bool in_plane : {false, true}) {
    Place place(1);
    place.preset = {
        .origin = {10, 20, 30}, .basic_rotation_deg = {30, 0, 0}, .rotary_offsets_deg = {}};
    place.plane = {.spatial_deg = {0, in_plane ? 12.0 : 0.0, 0}, .origin = {}};
    place.shift = {};
    place.foot = place.preset.origin;
    place.axes = {Axis::A, Axis::B};
    place.on_head = 0;
    place.start = {300, 300, 300};  // beside the part, which is boundless
    place.above = {30, 30, 60};
    place.stored = false;
    const auto on_part = [&](const Vec3& direction) {
      return turned_by(place.preset.basic_rotation_deg,
                       turned_by(place.plane.spatial_deg, turned_about(2, 2, direction)));
    };
    PlaneBench bench(place, {machine::Plane{place.foot, on_part({1, 0, 0})},
                             machine::Plane{place.foot, on_part({0, 1, 0})}});
    REQUIRE(bench.run(415, values("263=0 264=0 326=40 327=30 308=1 261=-5 320=0 260=40 304=1 305=0 "
                                  "331=0 332=0 303=1")) == 0);
    const machine::PresetFrame& row = bench.active();
    const Vec3 zero = place.reading(row, place.foot);
    CHECK(std::abs(zero.x) < 2e-6);
    CHECK(std::abs(zero.y) < 2e-6);
    const Vec3 along =
        turned_by(row.basic_rotation_deg, turned_by(place.plane.spatial_deg, {1, 0, 0}));
    CHECK(norm(along - on_part({1, 0, 0})) < 4e-9);
  }
}

}  // namespace fitgauge::probing

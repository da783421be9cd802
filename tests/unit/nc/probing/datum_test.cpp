#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

const machine::Block kDatumPlate{.min = {0, 0, -40}, .max = {100, 80, 0.3}};

Values block() { return values("263=50 264=40 294=0 320=0 260=50 333=5"); }

}  // namespace

TEST_CASE("417 stores the datum, 247 activates it: the touched point then reads Q333") {
  ProbingBench bench({kDatumPlate});
  CHECK(bench.run(417, with(block(), {{305, 9.0}, {303, 1.0}})) == 0);
  CHECK(same(bench.host.q[160], 0.3));
  CHECK(bench.preset(9).origin == machine::Vec3{0, 0, -4.7});
  CHECK(bench.machine.state().active_preset == 1);
  CHECK(bench.run(247, {{339, 9.0}}, CycleFamily::CyclDef) == 0);
  CHECK(bench.machine.state().active_preset == 9);
  CHECK(bench.run(417, with(block(), {{294, 5.0}, {305, 10.0}, {333, 5.0}})) == 0);
  CHECK(same(bench.host.q[160], 5));
  CHECK(bench.preset(10).origin == machine::Vec3{0, 0, -4.7});
}

TEST_CASE("417 with Q305 = 0 makes row 0 the active preset at once") {
  ProbingBench bench({kDatumPlate});
  CHECK(bench.run(417, with(block(), {{305, 0.0}, {303, -1.0}})) == 0);
  CHECK(bench.machine.state().active_preset == 0);
  CHECK(bench.preset(0).origin == machine::Vec3{0, 0, -4.7});
  CHECK(same(bench.machine.state().frames.from_machine({0, 0, 0.3}).z, 5));
}

TEST_CASE("417 changes only the probe axis of an existing row") {
  ProbingBench bench({kDatumPlate});
  machine::Preset other{.number = 4, .comment = "VICE", .frame = {}};
  other.frame.origin = {10, 20, 30};
  other.frame.basic_rotation_deg = {0, 0, 15};
  REQUIRE(bench.machine.write_preset(other).has_value());
  CHECK(bench.run(417, with(block(), {{305, 4.0}})) == 0);
  CHECK(bench.preset(4).origin == machine::Vec3{10, 20, -4.7});
  CHECK(bench.preset(4).basic_rotation_deg == machine::Vec3{0, 0, 15});
  CHECK(bench.machine.state().presets.find(4)->comment == "VICE");
}

TEST_CASE("417 with Q303 = 0 writes the active datum table, relative to the preset") {
  ProbingBench bench({kDatumPlate});
  const Values datum = with(block(), {{305, 3.0}, {303, 0.0}});
  CHECK(bench.run(417, datum) == 1043);
  bench.host.has_datum_table = true;
  machine::Frames frames = bench.machine.state().frames;
  frames.set_datum_shift({{0, 0, 0.1}, {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(417, datum) == 0);
  CHECK(same(bench.host.q[160], 0.2));
  const machine::AxisWords& values = bench.host.datums.at(3);
  CHECK_FALSE(values[machine::Axis::X].has_value());
  CHECK_FALSE(values[machine::Axis::Y].has_value());
  CHECK(same(*values[machine::Axis::Z], -4.7));
}

TEST_CASE("247 resets the transformations and takes a row by number or name") {
  ProbingBench bench;
  machine::Preset other{.number = 4, .comment = "VICE", .frame = {}};
  REQUIRE(bench.machine.write_preset(other).has_value());
  machine::Frames frames = bench.machine.state().frames;
  frames.set_datum_shift({{1, 2, 3}, {}});
  frames.set_scaling({{2, 2, 2}, {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(247, {{339, std::string("VICE")}}, CycleFamily::CyclDef) == 0);
  CHECK(bench.machine.state().active_preset == 4);
  CHECK_FALSE(bench.machine.state().frames.is_scaled());
  CHECK(bench.machine.state().frames.datum_shift() == machine::Position{});
  CHECK(bench.run(247, {{339, 77.0}}, CycleFamily::CyclDef) != 0);
  CHECK(bench.run(247, {{339, std::string("NOWHERE")}}, CycleFamily::CyclDef) == 1011);
  CHECK(bench.run(247, {{339, 1.5}}, CycleFamily::CyclDef) == 1011);
}

}  // namespace fitgauge::probing

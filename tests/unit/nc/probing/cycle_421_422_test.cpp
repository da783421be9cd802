#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;
using machine::Bore;
using machine::Boss;

/// The hole of the control's own example log: nominal 50, 65, diameter 12, off its centre.
Bore example_hole() {
  return {.centre = {50.0810, 64.9530}, .top = 0, .depth = 20, .diameter = 12.0259};
}
const Block kPlate{.min = {0, 0, -40}, .max = {200, 200, 0}};

Values example_block() {
  return {{273, 50.0}, {274, 65.0}, {262, 12.0}, {325, 0.0},    {247, 90.0}, {261, -5.0},
          {320, 0.0},  {260, 20.0}, {301, 0.0},  {275, 12.045}, {276, 12.0}, {279, 0.1},
          {280, 0.1},  {281, 1.0},  {309, 0.0},  {330, 0.0}};
}

/// A hole or stud of 25 in the middle of the plate, limits 25.021 and 25.
Values hole_block() {
  return {{273, 100.0}, {274, 100.0}, {262, 25.0},   {247, 90.0},
          {261, -5.0},  {260, 20.0},  {275, 25.021}, {276, 25.0}};
}
ProbingBench hole_of(double diameter, std::array<double, 2> centre = {100, 100}) {
  return ProbingBench(
      {kPlate, Bore{.centre = centre, .top = 0, .depth = 30, .diameter = diameter}});
}
Values stud_block() {
  return {{273, 100.0}, {274, 100.0}, {262, 25.0}, {247, 90.0},
          {261, 5.0},   {260, 30.0},  {277, 25.0}, {278, 24.979}};
}
ProbingBench stud_of(double diameter) {
  return ProbingBench(
      {kPlate, Boss{.centre = {100, 100}, .top = 10, .height = 10, .diameter = diameter}});
}

}  // namespace

TEST_CASE("421: the example of the control's own log") {
  ProbingBench bench({kPlate, example_hole()});
  REQUIRE(bench.run(421, example_block()) == 0);
  CHECK(same(bench.host.q[151], 50.081));
  CHECK(same(bench.host.q[152], 64.953));
  CHECK(same(bench.host.q[153], 12.0259));
  CHECK(same(bench.host.q[161], 0.081));
  CHECK(same(bench.host.q[162], -0.047));
  CHECK(same(bench.host.q[163], 0.0259));
  CHECK(bench.status() == 100);
  const std::string& log = bench.host.files.at("TCHPR421.TXT");
  CHECK(log ==
        "****** Measuring log of touch-probe cycle 421 MEASURE HOLE ******\n"
        "Date: 20-11-2026\n"
        "Time: 6:05:04\n"
        "Measuring program: TNC:\\nc_prog\\test\\part.h\n"
        "Unit (0=MM / 1=INCH): 0\n"
        "------------------------------------------------------------\n"
        "Nominal values:\n"
        "Centre, main axis:                                   50.0000\n"
        "Centre, secondary axis:                              65.0000\n"
        "Diameter:                                            12.0000\n"
        "------------------------------------------------------------\n"
        "Limits:\n"
        "Centre, main axis, maximum:                          50.1000\n"
        "Centre, main axis, minimum:                          49.9000\n"
        "Centre, secondary axis, maximum:                     65.1000\n"
        "Centre, secondary axis, minimum:                     64.9000\n"
        "Diameter, maximum:                                   12.0450\n"
        "Diameter, minimum:                                   12.0000\n"
        "------------------------------------------------------------\n"
        "Actual values:\n"
        "Centre, main axis:                                   50.0810\n"
        "Centre, secondary axis:                              64.9530\n"
        "Diameter:                                            12.0259\n"
        "------------------------------------------------------------\n"
        "Deviations:\n"
        "Centre, main axis:                                    0.0810\n"
        "Centre, secondary axis:                              -0.0470\n"
        "Diameter:                                             0.0259\n"
        "------------------------------------------------------------\n"
        "Further results:\n"
        "Measuring height:                                    -5.0000\n"
        "------------------------------------------------------------\n"
        "****** End of measuring log ******\n\n");
  REQUIRE(bench.host.records.size() == 1);
  const MeasuringRecord& record = bench.host.records.front();
  CHECK(record.cycle == 421);
  CHECK(record.verdict == gauging::Verdict::Good);
  CHECK(record.sizes.front().measured == Length::nanometres(12'025'900));
  REQUIRE(record.form.has_value());
  CHECK_FALSE(record.form->assessable);
}

TEST_CASE("421: good, rework and reject of a hole, limits inclusive") {
  struct Case {
    double diameter;
    int status;
    int error;
  };
  for (const Case& c : {Case{25.0105, 100, 0}, Case{25.021, 100, 0}, Case{25.0, 100, 0},
                        Case{25.0211, 1, 1047}, Case{24.9999, 10, 1046}}) {
    CAPTURE(c.diameter);
    ProbingBench bench = hole_of(c.diameter);
    CHECK(bench.run(421, hole_block()) == 0);
    CHECK(bench.status() == c.status);
    CHECK(bench.run(421, with(hole_block(), {{309, 1.0}})) == c.error);
    CHECK(bench.fault.kind ==
          (c.error == 0 ? CycleFaultKind::Error : CycleFaultKind::ToleranceStop));
    CHECK(bench.host.records.size() == 2);
    CHECK(same(bench.host.q[153], c.diameter));
  }
}

TEST_CASE("422: good, rework and reject of a stud, limits inclusive") {
  struct Case {
    double diameter;
    int status;
    int error;
  };
  for (const Case& c : {Case{24.99, 100, 0}, Case{25.0, 100, 0}, Case{24.979, 100, 0},
                        Case{25.0001, 10, 1049}, Case{24.9789, 1, 1048}}) {
    CAPTURE(c.diameter);
    ProbingBench bench = stud_of(c.diameter);
    CHECK(bench.run(422, with(stud_block(), {{309, 1.0}})) == c.error);
    CHECK(bench.status() == c.status);
    CHECK(same(bench.host.q[153], c.diameter));
    CHECK(same(bench.host.q[163], c.diameter - 25));
  }
}

TEST_CASE("421 and 422 reach every path between the points") {
  for (const double via_clearance : {0.0, 1.0}) {
    for (const double arc : {0.0, 1.0}) {
      for (const double step : {-90.0, 35.0}) {
        for (const double points : {3.0, 4.0}) {
          const Values path{{301, via_clearance}, {365, arc},    {247, step},
                            {325, 17.0},          {423, points}, {320, 1.5}};
          ProbingBench hole = hole_of(25.013);
          CHECK(hole.run(421, with(hole_block(), path)) == 0);
          CHECK(same(hole.host.q[153], 25.013));
          CHECK(hole.host.touches.size() == static_cast<std::size_t>(points));
          ProbingBench stud = stud_of(24.99);
          // A chord across 90 degrees would cut the stud.
          const bool collides = arc == 0 && via_clearance == 0 && step == -90;
          CHECK(stud.run(422, with(stud_block(), path)) == (collides ? -1 : 0));
          if (!collides) CHECK(same(stud.host.q[153], 24.99));
        }
      }
    }
  }
}

TEST_CASE("421 touches a hole too small for the clearance from its centre") {
  ProbingBench bench({kPlate, Bore{.centre = {100, 100}, .top = 0, .depth = 20, .diameter = 6}});
  CHECK(bench.run(421, with(hole_block(), {{262, 6.0}, {275, 6.01}, {276, 5.99}, {301, 1.0}})) ==
        0);
  CHECK(same(bench.host.q[153], 6.0));
}

TEST_CASE("421: a centre out of tolerance is reject, 0 switches the check off") {
  ProbingBench bench = hole_of(25.01, {100.1, 99.95});
  const Values block = with(hole_block(), {{309, 1.0}});
  CHECK(bench.run(421, with(block, {{279, 0.1}, {280, 0.05}})) == 0);
  CHECK(bench.run(421, with(block, {{279, 0.0999}, {280, 0.05}})) == 1044);
  CHECK(bench.status() == 1);
  CHECK(bench.run(421, with(block, {{279, 0.1}, {280, 0.0499}})) == 1045);
  CHECK(bench.run(421, with(block, {{279, 0.0}, {280, 0.0}})) == 0);
}

TEST_CASE("421 without limits is good, contradictory ones are an error") {
  ProbingBench bench = hole_of(26);
  CHECK(bench.run(421, with(hole_block(), {{275, 0.0}, {276, 0.0}, {309, 1.0}})) == 0);
  CHECK(bench.status() == 100);
  CHECK(bench.run(421, with(hole_block(), {{275, 25.0}, {276, 25.1}})) == 1016);
}

TEST_CASE("421 writes its log where Q281 says") {
  ProbingBench bench = hole_of(25.01);
  CHECK(bench.run(421, with(hole_block(), {{281, 0.0}})) == 0);
  CHECK(bench.host.files.empty());
  CHECK(bench.run(421, with(hole_block(), {{281, 2.0}})) == 0);
  CHECK(bench.host.files.empty());
  CHECK(bench.host.shown.size() == 1);
  bench.host.cycle_memory.fast_probing.interrupts = false;
  CHECK(bench.run(421, with(hole_block(), {{281, 2.0}})) == 0);
  CHECK(bench.host.shown.size() == 1);
  CHECK(bench.run(421, with(hole_block(), {{281, 1.0}})) == 0);
  const std::size_t size = bench.host.files.at("TCHPR421.TXT").size();
  CHECK(bench.run(421, with(hole_block(), {{281, 1.0}})) == 0);
  CHECK(bench.host.files.at("TCHPR421.TXT").size() == 2 * size);
}

TEST_CASE("Q330 corrects the radius of the named tool and watches for breakage") {
  machine::Setup setup{
      .machine = {},
      .features = {kPlate, Bore{.centre = {100, 100}, .top = 0, .depth = 30, .diameter = 25.013},
                   Boss{.centre = {30, 30}, .top = 10, .height = 10, .diameter = 24.99}}};
  machine::ToolSetup mill;
  mill.row.number = 7;
  mill.row.name = "MILL_D16";
  mill.row.l = 80;
  mill.row.r = 8;
  setup.machine.tools.push_back(mill);
  ProbingBench bench(setup);
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.0065));
  CHECK(bench.run(421, with(hole_block(), {{330, std::string("mill_d16")}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.013));
  const Values stud{{273, 30.0}, {274, 30.0}};
  CHECK(bench.run(422, with(with(stud_block(), stud), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.018));
  CHECK(bench.run(421, with(hole_block(), {{330, 8.0}})) == 1092);
  CHECK(bench.run(421, with(hole_block(), {{330, std::string("NONE")}})) == 1092);

  machine::Tool tool = *bench.machine.state().tools.find(7);
  tool.r_breakage = 0.013;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 0);
  tool = *bench.machine.state().tools.find(7);
  tool.r_breakage = 0.0129;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 1065);
  CHECK(bench.machine.state().tools.find(7)->locked);
}

TEST_CASE("421: errors of parameters, tools and motion") {
  ProbingBench bench = hole_of(25.01);
  CHECK(bench.run(421, with(hole_block(), {{247, 0.0}})) == 1066);
  CHECK(bench.run(421, with(hole_block(), {{247, 4.9}})) == 1067);
  CHECK(bench.run(421, with(hole_block(), {{247, 120.1}})) == 1004);
  CHECK(bench.run(421, with(hole_block(), {{423, 5.0}})) == 1004);
  CHECK(bench.run(421, {{273, 50.0}}) == 1017);
  CHECK(bench.run(421, with(hole_block(), {{274, 150.0}})) == -1);  // collides with the plate
  CHECK(hole_of(80).run(421, hole_block()) == 1014);
  ProbingBench turning = hole_of(25.01);
  machine::Modes modes = turning.machine.state().modes;
  modes.mode = machine::OperatingMode::Turn;
  REQUIRE(turning.machine.set_modes(modes).has_value());
  CHECK(turning.run(421, hole_block()) == 1097);
}

TEST_CASE("421: three lobes move the centre, four change the diameter") {
  const auto lobed = [](int lobes) {
    Bore bore{.centre = {100, 100}, .top = 0, .depth = 30, .diameter = 25.01};
    bore.lobes = lobes;
    bore.lobe_amplitude_um = 5;
    return ProbingBench({kPlate, bore});
  };
  ProbingBench three = lobed(3);
  CHECK(three.run(421, hole_block()) == 0);
  CHECK(std::abs(three.host.q[153] - 25.01) < 1e-4);
  CHECK(std::abs(three.host.q[161]) > 0.003);
  ProbingBench four = lobed(4);
  CHECK(four.run(421, hole_block()) == 0);
  CHECK(std::abs(four.host.q[153] - 25.02) < 1e-4);
  ProbingBench two = lobed(2);
  CHECK(two.run(421, hole_block()) == 0);
  CHECK(*two.host.records.front().form->residual_mm > 0.004);
}

TEST_CASE("a shifted, rotated or scaled frame gives the same results in its own coordinates") {
  using machine::Frames;
  const auto measure_in = [](const Frames& frames) {
    // The part lies in the frame as it lay before.
    const double scale = frames.scaling().factor.x;
    const machine::Vec3 centre = frames.to_machine({100.02, 99.97, 0});
    ProbingBench bench({Block{.min = {-400, -400, centre.z - 60}, .max = {400, 400, centre.z}},
                        Bore{.centre = {centre.x, centre.y},
                             .top = centre.z,
                             .depth = 50,
                             .diameter = 25.01 * scale}});
    REQUIRE(bench.machine.set_frames(frames).has_value());
    REQUIRE(bench.run(421, hole_block()) == 0);
    CHECK(same(bench.host.q[151], 100.02));
    CHECK(same(bench.host.q[152], 99.97));
    CHECK(same(bench.host.q[153], 25.01));
  };
  Frames shifted;
  shifted.set_datum_shift({{-50, 20, -10}, {}});
  measure_in(shifted);
  Frames rotated;
  rotated.set_rotation({33, machine::Axis::Z});
  measure_in(rotated);
  Frames scaled;
  scaled.set_scaling({{1.5, 1.5, 1.5}, {}});
  measure_in(scaled);
  Frames mirrored;
  mirrored.set_mirror({true, false, false});
  measure_in(mirrored);
}

TEST_CASE("measuring resets a basic rotation and refuses unequal scaling") {
  ProbingBench bench = hole_of(25.01);
  machine::Frames frames = bench.machine.state().frames;
  frames.set_preset({.origin = {}, .basic_rotation_deg = {0, 0, 5}, .rotary_offsets_deg = {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(421, hole_block()) == 0);
  CHECK(same(bench.host.q[151], 100));
  CHECK(bench.machine.state().frames.preset().basic_rotation_deg == machine::Vec3{});
  frames = bench.machine.state().frames;
  frames.set_scaling({{1, 1.1, 1}, {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(421, hole_block()) == 1108);
}

TEST_CASE("422 in the planes of the other tool axes: the equator of a sphere") {
  using machine::Axis;
  struct Case {
    Axis tool_axis;
    double main;
    double secondary;
    double height;
  };
  for (const Case& c : {Case{Axis::X, 30, 10, -20}, Case{Axis::Y, 10, -20, 30}}) {
    ProbingBench bench({machine::Sphere{.centre = {-20, 30, 10}, .diameter = 24.99}});
    machine::AxisWords aside;
    aside[c.tool_axis] = 120.0;
    REQUIRE(bench.machine.move({aside, {}}).has_value());
    machine::AxisWords level;
    level[Axis::Z] = 10.0;
    REQUIRE(bench.machine.move({level, {}}).has_value());
    REQUIRE(bench.machine.call_tool({.number = {}, .axis = c.tool_axis, .spindle_rpm = {}})
                .has_value());
    for (const double via_clearance : {0.0, 1.0}) {
      CHECK(bench.run(422, with(stud_block(), {{273, c.main},
                                               {274, c.secondary},
                                               {261, c.height},
                                               {260, 60.0},
                                               {301, via_clearance}})) == 0);
      CHECK(std::abs(bench.host.q[151] - c.main) < 2e-6);
      CHECK(std::abs(bench.host.q[152] - c.secondary) < 2e-6);
      CHECK(std::abs(bench.host.q[153] - 24.99) < 2e-6);
    }
  }
}

TEST_CASE("the log of an INCH program counts in inches") {
  ProbingBench bench = hole_of(25.4);
  bench.host.inch = true;
  CHECK(bench.run(421, with(hole_block(), {{262, 25.4}, {275, 0.0}, {276, 0.0}})) == 0);
  const std::string& log = bench.host.files.at("TCHPR421.TXT");
  CHECK(log.find("Unit (0=MM / 1=INCH): 1\n") != std::string::npos);
  CHECK(log.find("Diameter:                                           1.000000\n") !=
        std::string::npos);
}

TEST_CASE("Q115 to Q117 are the spindle position of the last touch") {
  ProbingBench bench = hole_of(25);
  CHECK(bench.run(421, hole_block()) == 0);
  CHECK(same(bench.host.q[115], 100));
  CHECK(same(bench.host.q[116], 100 - 12.5 + 2));
  CHECK(same(bench.host.q[117], -5 - 2 + 120));
}

}  // namespace fitgauge::probing

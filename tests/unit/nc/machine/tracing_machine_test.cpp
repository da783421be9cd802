#include "support/tracing_machine.hpp"

#include <doctest/doctest.h>

#include "nc/machine/simulated_machine.hpp"
#include "unit/nc/machine/machine_check.hpp"

using namespace fitgauge::machine;

namespace {

Setup face_setup() {
  Setup setup;
  setup.features = {Block{{0, 0, -40}, {100, 80, 0}}};
  setup.machine.presets[0].frame.origin = {10, 10, 0};
  return setup;
}

LinearMove to(const Vec3& point, const Feed& feed) {
  LinearMove move;
  move.target = AxisWords::linear(point);
  move.feed = feed;
  return move;
}

void run(Machine& machine) {
  CHECK(ok(machine.call_tool({30, Axis::Z, 50.0, 0, 0.25, 0})));
  CHECK(ok(machine.move(to({20, 20, 10}, Feed::rapid()))));
  CHECK(ok(machine.move(to({20, 20, 10}, Feed::rapid()))));  // stands there already
  CHECK(ok(machine.move(to({26, 28, 10}, Feed::at(600)))));
  CHECK(ok(machine.move_arc({{26, 28, 10}, {26, 20, 0}, -360, Axis::Z, Feed::at(1000)})));
  CHECK(ok(machine.probe({{0, 0, -1}, 20, 120, CoordinateSystem::Input, std::nullopt, {}})));
  CHECK_FALSE(machine.move(to({26, 28, -1}, Feed::at(600))).has_value());
  CHECK(ok(machine.dwell(0.5)));
  machine.stop("M0");
}

}  // namespace

TEST_CASE("a trace holds every move with its feed, time and contact") {
  std::vector<TracedMove> moves;
  TracingMachine machine(face_setup(), {[&](const TracedMove& move) { moves.push_back(move); }});
  run(machine);
  REQUIRE(moves.size() == 6);
  CHECK(moves[0].kind == MoveKind::Rapid);
  check_near(moves[0].start.linear, {-10, -10, 380});
  check_near(moves[0].end.linear, {20, 20, 10});
  CHECK(moves[0].feed_mm_min == 15000);
  CHECK(near(moves[0].seconds, std::sqrt(30.0 * 30 * 2 + 370.0 * 370) / 15000 * 60));
  CHECK(moves[1].kind == MoveKind::Feed);
  CHECK(near(moves[1].seconds, 1));
  CHECK(moves[2].kind == MoveKind::Arc);
  check_near(moves[2].end.linear, moves[2].start.linear);
  CHECK(near(moves[2].seconds, 16 * kPi / 1000 * 60));
  CHECK(moves[3].kind == MoveKind::Probe);
  CHECK(moves[3].feed_mm_min == 120);
  CHECK(near(moves[3].seconds, 5));
  check_near(moves[3].end.linear, {26, 28, 0}, 1e-8);
  REQUIRE(moves[3].contact);
  // DR makes the ball larger for the control than it is; the tip that touches stays the same.
  check_near(moves[3].contact->surface, {26, 28, 0});
  CHECK(moves[4].kind == MoveKind::Rapid);
  check_near(moves[4].start.linear, moves[3].end.linear);
  check_near(moves[4].end.linear, {26, 28, 10});
  CHECK(moves[5].kind == MoveKind::Feed);  // as far as the collision
  check_near(moves[5].end.linear, {26, 28, 0}, 2e-6);
  double seconds = 0.5;
  for (const TracedMove& move : moves) seconds += move.seconds;
  CHECK(near(seconds, machine.state().elapsed_s));
}

TEST_CASE("a traced move is drawn from itself alone, also where the coordinates have changed") {
  std::vector<TracedMove> moves;
  TracingMachine machine(face_setup(), {[&](const TracedMove& move) { moves.push_back(move); }});
  CHECK(ok(machine.call_tool({.number = 30, .axis = Axis::Z, .spindle_rpm = {}})));
  Preset preset;
  preset.number = 4;
  preset.frame.origin = {10, 20, 5};
  preset.frame.basic_rotation_deg = {0, 0, 90};
  CHECK(ok(machine.write_preset(preset)));
  CHECK(ok(machine.move(to({20, 20, 30}, Feed::rapid()))));
  CHECK(ok(machine.activate_preset(4)));
  CHECK(ok(machine.move(to({8, 0, 10}, Feed::at(600)))));
  CHECK(ok(machine.move_arc({{0, 8, 13}, {0, 0, 0}, 450, Axis::Z, Feed::at(1000)})));
  CHECK(ok(machine.probe({{0, 0, -1}, 40, 120, CoordinateSystem::Input, std::nullopt, {}})));

  REQUIRE(moves.size() == 5);
  for (std::size_t k = 1; k < moves.size(); ++k) {
    check_near(moves[k].machine_start, moves[k - 1].machine_end);
  }
  // Input (x, y, z) is Machine (10 - y, 20 + x, 5 + z).
  check_near(moves[1].machine_end, {10, 28, 15});
  const TracedMove& arc = moves[2];
  REQUIRE(arc.arc);
  check_near(arc.arc->machine_centre, {10, 20, 15});
  check_near(arc.arc->machine_axis, {0, 0, 1});
  for (const double part : {0.0, 0.3, 1.0}) {  // the helix, worked out from what the trace says
    const Vec3 from = arc.machine_start - arc.arc->machine_centre;
    const Vec3 turned = Matrix3::rotation(arc.arc->machine_axis, arc.arc->sweep_deg * part) * from;
    const double rise = dot(arc.machine_end - arc.machine_start, arc.arc->machine_axis);
    const Vec3 at = arc.arc->machine_centre + turned + arc.arc->machine_axis * (rise * part);
    if (part == 0) check_near(at, arc.machine_start);
    if (part == 1) check_near(at, arc.machine_end);
    CHECK(near(norm(at - arc.arc->machine_centre - arc.arc->machine_axis * (rise * part)), 8));
  }
  const TracedMove& probe = moves[3];
  REQUIRE(probe.contact);
  check_near(probe.contact->machine_surface, {2, 20, 0});
  REQUIRE(probe.contact->normal);
  check_near(*probe.contact->normal, {0, 0, 1}, 1e-6);

  machine.set_frames([&] {
    Frames mirrored = machine.state().frames;
    mirrored.set_mirror({true, false, false});
    return mirrored;
  }());
  CHECK(ok(machine.move(to({8, 0, 20}, Feed::rapid()))));
  CHECK(ok(machine.move_arc({{0, 8, 20}, {0, 0, 0}, 90, Axis::Z, Feed::at(1000)})));
  check_near(moves.back().arc->machine_axis, {0, 0, -1});
}

TEST_CASE("each command writes a line") {
  TracingMachine machine(face_setup(), {{}, 1000, true});
  run(machine);
  Preset preset;
  preset.number = 4;
  preset.frame.origin = {1, 2, 3};
  CHECK(ok(machine.write_preset(preset)));
  CHECK(ok(machine.activate_preset(4)));
  CHECK_FALSE(machine.activate_preset(5).has_value());
  const std::vector<std::string> expected{
      "TOOL CALL 30 Z S50 DL+0.0000 DR+0.2500",
      "L X+20.0000 Y+20.0000 Z+10.0000 FMAX",
      "L X+20.0000 Y+20.0000 Z+10.0000 FMAX",
      "L X+26.0000 Y+28.0000 Z+10.0000 F600",
      "ARC X+26.0000 Y+28.0000 Z+10.0000 CC X+26.0000 Y+20.0000 Z+0.0000 -360.0000 F1000",
      "PROBE X+0.0000 Y+0.0000 Z-1.0000 F120 TOUCHED X+26.0000 Y+28.0000 Z+0.0000",
      ("L X+26.0000 Y+28.0000 Z+0.0000 F600 ! Touch probe collision: the ball stands at "
       "X+26.0000 Y+28.0000 Z+2.2500"),
      "DWELL 0.5",
      "STOP M0",
      "PRESET ROW 4 X+1.0000 Y+2.0000 Z+3.0000 SPA+0.0000 SPB+0.0000 SPC+0.0000",
      "PRESET 4",
      "PRESET 5 ! Preset not found: row 5"};
  REQUIRE(machine.lines().size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(machine.lines()[k] == expected[k]);
}

TEST_CASE("a full trace counts what it drops, and keeps no more") {
  int kept = 0;
  TracingMachine machine(face_setup(), {[&kept](const TracedMove&) { ++kept; }, 2, true});
  run(machine);
  CHECK(kept == 2);
  CHECK(machine.lines().size() == 2);
  CHECK(machine.dropped() == 4);
}

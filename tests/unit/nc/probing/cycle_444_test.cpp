#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::unit;
using machine::Vec3;

/// A point on the upper face of a plate.
Values top_point() {
  return {{263, 50.0}, {264, 40.0}, {294, 0.0},
          {581, 0.0},  {582, 0.0},  {583, 1.0},
          {260, 50.0}, {309, 0.0},  {400, std::string("0.4-0.1")}};
}

machine::Block plate(double top) { return {.min = {0, 0, -40}, .max = {100, 80, top}}; }

Values block_at(const Vec3& nominal, const Vec3& normal, double clearance_height) {
  return {
      {263, nominal.x}, {264, nominal.y}, {294, nominal.z},        {581, normal.x},
      {582, normal.y},  {583, normal.z},  {260, clearance_height}, {400, std::string("0.1-0.1")}};
}

/// Results of a point that lies `deviation` along `normal` (length 1) from its nominal place.
void check_results(ProbingBench& bench, const Vec3& nominal, const Vec3& normal, double deviation) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    CHECK(std::abs(bench.host.q[151 + axis] - (nominal[i] + normal[i] * deviation)) < 1.5e-6);
    CHECK(std::abs(bench.host.q[161 + axis] - normal[i] * deviation) < 1.5e-6);
  }
  CHECK(same(bench.host.q[164], deviation));
}

/// A bench on a trunnion table with an inclined face, 0.03 mm too high along its normal.
constexpr double kTooHigh = 0.03;
const Vec3 kFacePoint{20, 10, -10};
ProbingBench bench_with_face(const Vec3& normal) {
  machine::Setup setup;
  setup.machine.axes[index(Axis::A)] = machine::AxisSetup::of(Axis::A);
  setup.machine.axes[index(Axis::C)] = machine::AxisSetup::of(Axis::C);
  setup.features = {machine::Plane{kFacePoint + unit(normal) * kTooHigh, normal}};
  return ProbingBench(setup);
}

}  // namespace

TEST_CASE("444: good, rework and reject along the normal, limits inclusive, and what stops") {
  struct Case {
    double deviation;
    double status;
    int error_of_1;
    int error_of_2;
  };
  for (const Case& c : {Case{0, 0, 0, 0}, Case{0.0137, 0, 0, 0}, Case{0.4, 0, 0, 0},
                        Case{-0.1, 0, 0, 0}, Case{0.4001, 1, 1072, 0}, Case{1.9, 1, 1072, 0},
                        Case{-0.1001, 2, 1072, 1072}, Case{-9, 2, 1072, 1072}}) {
    CAPTURE(c.deviation);
    ProbingBench bench({plate(c.deviation)});
    CHECK(bench.run(444, top_point()) == 0);
    CHECK(bench.host.q[183] == c.status);
    check_results(bench, {50, 40, 0}, {0, 0, 1}, c.deviation);
    CHECK(bench.run(444, with(top_point(), {{309, 1.0}})) == c.error_of_1);
    CHECK(bench.run(444, with(top_point(), {{309, 2.0}})) == c.error_of_2);
    CHECK(bench.fault.kind ==
          (c.error_of_1 == 0 ? machine::FaultKind::Error : machine::FaultKind::Stop));
    CHECK(bench.host.q[183] == c.status);
    REQUIRE(bench.host.records.size() == 3);
    CHECK(same(bench.host.records.back().sizes.front().measured.to_mm(), c.deviation));
  }
}

TEST_CASE("444: one nanometre decides") {
  ProbingBench bench({plate(0.400001)});
  CHECK(bench.run(444, top_point()) == 0);
  CHECK(bench.host.q[183] == 1);
  CHECK(bench.run(444, with(top_point(), {{400, std::string("0.400001")}})) == 0);
  CHECK(bench.host.q[183] == 0);
}

TEST_CASE("444 without a tolerance: undefined status, no stop, no verdict") {
  for (const char* text : {"", " ", "0", "0.1+0.1"}) {
    ProbingBench bench({plate(-2)});
    CHECK(bench.run(444, with(top_point(), {{400, std::string(text)}, {309, 1.0}})) == 0);
    CHECK(bench.host.q[183] == -1);
    CHECK(same(bench.host.q[164], -2));
    REQUIRE(bench.host.records.size() == 1);
    CHECK_FALSE(bench.host.records.front().verdict.has_value());
    CHECK(contains(log_of(bench, 444), "No tolerance (Q183 = -1)"));
    CHECK_FALSE(contains(log_of(bench, 444), "Upper limit<"));
  }
}

TEST_CASE("444 takes the length of the normal for nothing") {
  for (const double length : {10.0, 0.5, 1e-6, 1e-300}) {
    ProbingBench bench({plate(0.02)});
    CHECK(bench.run(444, with(top_point(), {{583, length}})) == 0);
    check_results(bench, {50, 40, 0}, {0, 0, 1}, 0.02);
  }
}

TEST_CASE("444 starts at radius, SET_UP and Q320 along the normal and goes back the same way") {
  const Vec3 normal = unit({2, -1, 2});
  ProbingBench bench({machine::Plane{kFacePoint, normal}});
  REQUIRE(bench.run(444, with(block_at(kFacePoint, {2, -1, 2}, 60), {{320, 3.0}})) == 0);
  check_results(bench, kFacePoint, normal, 0);
  const Vec3 start = kFacePoint + normal * (2 + 2 + 3);
  const Vec3 end = bench.machine.position().linear;
  CHECK(same(end.x, start.x));
  CHECK(same(end.y, start.y));
  CHECK(same(end.z, start.z - 2));  // the tip below the ball centre
  // The contact lies SET_UP and Q320 from the start at the probing feed of 500 mm/min.
  REQUIRE(bench.host.touches.size() == 1);
  CHECK(std::abs(bench.host.touches.front().seconds - 5.0 / 500 * 60) < 1e-6);
}

TEST_CASE("444 travels DIST at most") {
  ProbingBench bench({plate(0)});
  CHECK(bench.run(444, with(top_point(), {{320, 17.9}})) == 0);
  CHECK(bench.run(444, with(top_point(), {{320, 18.1}})) == 1014);
  CHECK(bench.host.q[183] == -1);
  CHECK(bench.host.records.size() == 1);
}

TEST_CASE("444 refuses what it cannot work with") {
  const auto error_after = [](const Values& changes) {
    ProbingBench bench({plate(0)});
    return bench.run(444, with(top_point(), changes));
  };
  CHECK(error_after({{583, 10.1}}) == 1004);
  CHECK(error_after({{309, 3.0}}) == 1004);
  CHECK(error_after({{309, 0.5}}) == 1011);
  CHECK(error_after({{400, 0.4}}) == 1011);
  CHECK(error_after({{400, std::string("0.4/0.1")}}) == 1011);
  CHECK(error_after({{400, std::string("0.1-123456")}}) == 1004);
  CHECK(error_after({{320, -1.0}}) == 1004);
}

TEST_CASE("444 keeps a basic rotation under a shift and a rotation") {
  const Vec3 normal = unit({1, 2, 2});
  ProbingBench bench = bench_with_face(normal);
  machine::Frames frames = bench.machine.state().frames;
  frames.set_preset(
      {.origin = {5, 6, -7}, .basic_rotation_deg = {0, 0, -12}, .rotary_offsets_deg = {}});
  frames.set_datum_shift({{1, 2, 3}, {}});
  frames.set_rotation({.angle_deg = -70, .tool_axis = Axis::Z});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  const Vec3 nominal = frames.from_machine(kFacePoint);
  const Vec3 direction = frames.direction_from_machine(normal);
  CHECK(bench.run(444, block_at(nominal, direction, nominal.z + 80)) == 0);
  check_results(bench, nominal, direction, kTooHigh);
  CHECK(bench.host.q[183] == 0);
  CHECK(bench.machine.state().frames.preset() == frames.preset());
}

TEST_CASE("444 in a tilted plane, whose rotary axes must stand square to it") {
  for (const Vec3& in_plane : {Vec3{0, 0, 1}, Vec3{1, -1, 2}}) {
    const Vec3 normal = machine::Matrix3::spatial({30, 0, 0}) * unit(in_plane);
    ProbingBench bench = bench_with_face(normal);
    machine::Frames frames = bench.machine.state().frames;
    frames.set_plane(machine::TiltedPlane{{30, 0, 0}, {20, 10, -10}});
    REQUIRE(bench.machine.set_frames(frames).has_value());
    const Values block = block_at({}, in_plane, 80);
    CHECK(bench.run(444, block) == 1099);
    const Vec3 up = machine::Matrix3::spatial({30, 0, 0}) * Vec3{0, 0, 1};
    const auto found = bench.machine.state().kinematics.orientations(up, {}, Axis::Z);
    REQUIRE_FALSE(found.empty());
    bench.move(Axis::A, found.front().x);
    CHECK(bench.run(444, block) == 0);
    check_results(bench, {}, unit(in_plane), kTooHigh);
    CHECK(bench.host.q[183] == 0);
  }
}

TEST_CASE("444 with TCPM measures in workpiece coordinates whatever the inclination") {
  const Vec3 normal = unit({1, 2, 2});
  for (const double a : {0.0, 25.0, -40.0}) {
    ProbingBench bench = bench_with_face(normal);
    machine::Modes modes = bench.machine.state().modes;
    modes.tcpm = true;
    REQUIRE(bench.machine.set_modes(modes).has_value());
    bench.move(Axis::A, a);
    CHECK(bench.run(444, block_at(kFacePoint, normal, 80)) == 0);
    check_results(bench, kFacePoint, normal, kTooHigh);
  }
}

TEST_CASE("444 with the tool axis X: main axis Y, secondary axis Z, probe axis X") {
  ProbingBench bench({machine::Plane{{-7, 0, 0}, {1, 0, 0}}});
  bench.move(Axis::X, 300);
  bench.call(30, Axis::X);
  CHECK(bench.run(444, block_at({3, 4, -7.02}, {0, 0, 1}, 60)) == 0);
  check_results(bench, {3, 4, -7.02}, {0, 0, 1}, 0.02);
  CHECK(contains(log_of(bench, 444),
                 "<th scope=\"col\">Y</th><th scope=\"col\">Z</th>"
                 "<th scope=\"col\">X</th>"));
}

TEST_CASE("444 logs vector, nominal, limits, actual and deviation in one page for all points") {
  ProbingBench bench({plate(0.013)});
  REQUIRE(bench.run(444, top_point()) == 0);
  const std::string first = log_of(bench, 444);
  for (const char* part :
       {"<!DOCTYPE html>", "Measuring program: TNC:\\nc_prog\\test\\part.h", "Lengths in mm",
        "20-11-2026 at 6:05:04", "<p class=\"verdict good\">\u2713 Good (Q183 = 0)</p>",
        "Probing direction vector</th><td>0.0000</td><td>0.0000</td><td>-20.0000</td>"
        "<td>-20.0000</td>",
        "Nominal</th><td>50.0000</td><td>40.0000</td><td>0.0000</td><td>0.0000</td>",
        "Upper limit</th><td>50.0000</td><td>40.0000</td><td>0.4000</td><td>0.4000</td>",
        "Lower limit</th><td>50.0000</td><td>40.0000</td><td>-0.1000</td><td>-0.1000</td>",
        "Actual</th><td>50.0000</td><td>40.0000</td><td class=\"judged good\">0.0130</td>"
        "<td class=\"judged good\">0.0130</td>",
        "Deviation</th><td>0.0000</td><td>0.0000</td><td class=\"judged good\">0.0130</td>"
        "<td class=\"judged good\">0.0130</td>"}) {
    CAPTURE(part);
    CHECK(contains(first, part));
  }
  for (const char* outside : {"http", "src=", "href=", "url(", "@import"}) {
    CHECK_FALSE(contains(first, outside));
  }
  REQUIRE(bench.run(444, with(top_point(), {{294, 1.0}})) == 0);
  REQUIRE(bench.run(444, with(top_point(), {{294, -1.0}})) == 0);
  const std::string& all = log_of(bench, 444);
  CHECK(all.substr(0, first.size()) == first);
  CHECK(all.find("<!DOCTYPE", 1) == std::string::npos);
  CHECK(contains(all, "Scrap: below the lower limit (Q183 = 2)"));
  CHECK(contains(all, "Rework: above the upper limit (Q183 = 1)"));
  // The next run begins the file anew.
  bench.host.memory().end_program();
  REQUIRE(bench.run(444, top_point()) == 0);
  CHECK(log_of(bench, 444) == first);
}

TEST_CASE("444 logs in inches for an inch program and escapes the path of the program") {
  ProbingBench bench({plate(0.254)});
  bench.host.inch = true;
  bench.host.path = "TNC:\\<b>&\"'\\part.h";
  REQUIRE(bench.run(444, with(top_point(), {{400, std::string("0.01-0.001")}})) == 0);
  CHECK(bench.host.q[183] == 0);
  CHECK(contains(log_of(bench, 444), "Lengths in inch"));
  CHECK(contains(log_of(bench, 444), "<td class=\"judged good\">0.010000</td>"));
  CHECK(contains(log_of(bench, 444), "TNC:\\&lt;b&gt;&amp;&quot;&#39;\\part.h<"));
}

}  // namespace fitgauge::probing

#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {

TEST_CASE("420 measures the angle of an edge to the main axis") {
  const Values along_main =
      values("263=10 264=30 265=60 266=30 272=2 267=1 261=0 260=100 301=1 281=1 320=5");
  for (const double angle : {0.0, 1.5, -2.25}) {
    ProbingBench bench({edge_at(angle)});
    CHECK(bench.run(420, along_main) == 0);
    CHECK(std::abs(bench.host.q[150] - angle) < 1e-7);
    CHECK(bench.host.files.at("TCHPR420.TXT").find("Measured angle:") != std::string::npos);
    // Two touched coordinates, which nothing judges.
    REQUIRE(bench.host.records.size() == 1);
    CHECK(bench.host.records.front().sizes.size() == 2);
    CHECK_FALSE(bench.host.records.front().verdict.has_value());
  }
  const Values across{{263, -30.0}, {264, 10.0}, {265, -30.0}, {266, 60.0}, {272, 1.0},
                      {267, -1.0},  {261, 0.0},  {260, 100.0}, {320, 5.0},  {281, 0.0}};
  for (const double angle : {90.0, 91.5, 88.0}) {
    ProbingBench bench({edge_at(angle)});
    bench.host.q[180] = 1;
    CHECK(bench.run(420, across) == 0);
    CHECK(bench.host.q[180] == 1);
    CHECK(std::abs(bench.host.q[150] - angle) < 1e-7);
    CHECK(bench.host.files.empty());
  }
}

TEST_CASE("420 in the probe axis measures the slope along the axis in which the points differ") {
  const auto slope = [](const machine::Vec3& normal, double x2, double y2) {
    ProbingBench bench({machine::Plane{.point = {0, 0, 0}, .normal = normal}});
    CHECK(bench.run(420, with(values("263=0 264=0 272=3 267=-1 261=0 260=50"),
                              {{265, x2}, {266, y2}})) == 0);
    return bench.host.q[150];
  };
  const double up = std::tan(machine::radians(2));
  CHECK(std::abs(slope({-up, 0, 1}, 40, 0) - 2) < 1e-7);
  CHECK(std::abs(slope({0, up, 1}, 0, 40) + 2) < 1e-7);
}

TEST_CASE("420: a collision") {
  ProbingBench bench({edge_at(0)});
  const Values block = values("263=10 264=30 265=10 266=30 272=2 267=1 261=0 260=100");
  CHECK(bench.run(420, with(block, {{265, 60.0}, {266, 300.0}, {264, 300.0}})) == -1);
}

TEST_CASE("431 gives the angles that tilt the working plane into the measured one") {
  const auto measure = [](const machine::Vec3& spatial) {
    const machine::Matrix3 tilt = machine::Matrix3::spatial(spatial);
    const machine::Vec3 main = tilt * machine::Vec3{1, 0, 0};
    const machine::Vec3 secondary = tilt * machine::Vec3{0, 1, 0};
    const machine::Vec3 normal = tilt * machine::Vec3{0, 0, 1};
    ProbingBench bench({machine::Plane{.point = {0, 0, 0}, .normal = normal}});
    const machine::Vec3 second = main * 50;
    const machine::Vec3 third = secondary * 40 + main * 10;
    CHECK(bench.run(431, with(values("263=0 264=0 294=0 260=60"), {{265, second.x},
                                                                   {266, second.y},
                                                                   {295, second.z},
                                                                   {296, third.x},
                                                                   {297, third.y},
                                                                   {298, third.z}})) == 0);
    CHECK(same(bench.host.q[173], 0));
    CHECK(std::abs(bench.host.q[174] - second.z) < 1e-6);
    CHECK(std::abs(bench.host.q[175] - third.z) < 1e-6);
    CHECK(std::abs(bench.host.q[158] - machine::degrees(std::atan2(-normal.y, normal.z))) < 1e-6);
    CHECK(std::abs(bench.host.q[159] - machine::degrees(std::atan2(normal.x, normal.z))) < 1e-6);
    return machine::Vec3{bench.host.q[170], bench.host.q[171], bench.host.q[172]};
  };
  CHECK(measure({0, 0, 0}) == machine::Vec3{});
  CHECK(norm(measure({10, 0, 0}) - machine::Vec3{10, 0, 0}) < 1e-6);
  CHECK(norm(measure({0, -12, 0}) - machine::Vec3{0, -12, 0}) < 1e-6);
  CHECK(norm(measure({5, 7, 0}) - machine::Vec3{5, 7, 0}) < 1e-4);
}

}  // namespace fitgauge::probing

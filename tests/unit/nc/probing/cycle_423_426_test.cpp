#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;

/// A pocket or slot of the given size around 100, 80.
std::vector<machine::Feature> pocket_of(double length, double width, double dx = 0, double dy = 0) {
  return pocket(100 + dx - length / 2, 80 + dy - width / 2, 100 + dx + length / 2,
                80 + dy + width / 2);
}
std::vector<machine::Feature> stud(double length, double width) {
  return {Block{.min = {100 - length / 2, 80 - width / 2, -40},
                .max = {100 + length / 2, 80 + width / 2, 0}}};
}

Values rectangle_block() {
  return {{273, 100.0}, {274, 80.0},  {282, 60.0},  {283, 40.0},  {261, -5.0}, {260, 20.0},
          {284, 60.02}, {285, 59.98}, {286, 40.02}, {287, 39.98}, {309, 1.0}};
}

Values slot_block() {
  return values("328=100 329=80 272=2 261=-5 260=20 311=30 288=30.03 289=29.97 309=1");
}
Values ridge_block() {
  return {{263, 100.0}, {264, 95.0}, {265, 100.0}, {266, 65.0},  {272, 2.0}, {261, -5.0},
          {260, 20.0},  {311, 30.0}, {288, 30.03}, {289, 29.97}, {309, 1.0}};
}

struct Case {
  double length;
  double width;
  int status;
  int error;
};

}  // namespace

TEST_CASE("423: both lengths on their limits, and one too short with the other too long") {
  for (const Case& c :
       {Case{60.02, 39.98, 100, 0}, Case{59.98, 40.02, 100, 0}, Case{59.9799, 40.0201, 1, 1053}}) {
    CAPTURE(c.length);
    CAPTURE(c.width);
    ProbingBench bench(pocket_of(c.length, c.width));
    CHECK(bench.run(423, rectangle_block()) == c.error);
    CHECK(bench.status() == c.status);
    check_q(bench, {{151, 100},
                    {152, 80},
                    {154, c.length},
                    {155, c.width},
                    {164, c.length - 60},
                    {165, c.width - 40}});
    CHECK(bench.host.records.front().sizes.size() == 4);
  }
}

TEST_CASE("423: the centre against its tolerance, and contradictory limits") {
  ProbingBench bench(pocket_of(60, 40, 0.05, -0.03));
  CHECK(bench.run(423, with(rectangle_block(), {{279, 0.05}, {280, 0.03}})) == 0);
  check_q(bench, {{161, 0.05}, {162, -0.03}});
  CHECK(bench.run(423, with(rectangle_block(), {{279, 0.049}, {280, 0.03}})) == 1044);
  CHECK(bench.run(423, with(rectangle_block(), {{280, 0.0299}})) == 1045);
  CHECK(bench.run(423, with(rectangle_block(), {{284, 59.0}})) == 1016);
  CHECK(bench.run(423, with(rectangle_block(), {{286, 39.0}})) == 1016);
}

TEST_CASE("423 touches a small pocket from its centre") {
  ProbingBench bench(pocket_of(7, 6));
  CHECK(bench.run(423, with(rectangle_block(), values("282=7 283=6 284=0 285=0 286=0 287=0"))) ==
        0);
  check_q(bench, {{154, 7}, {155, 6}});
}

TEST_CASE("424: both lengths correct the tool by their mean") {
  machine::Setup setup{.machine = {}, .features = stud(60.02, 40.01)};
  setup.machine.tools.push_back(tool_of(7, 80, 8));
  ProbingBench bench(setup);
  CHECK(bench.run(424, with(rectangle_block(), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, -0.0075));
}

TEST_CASE("425: good, rework and reject of a slot, limits inclusive") {
  for (const Case& c : {Case{60, 30, 100, 0}, Case{60, 30.03, 100, 0}, Case{60, 29.97, 100, 0},
                        Case{60, 30.0301, 1, 1058}, Case{60, 29.9699, 10, 1059}}) {
    CAPTURE(c.width);
    for (const double offset : {0.0, -15.0}) {
      for (const double via_clearance : {0.0, 1.0}) {
        ProbingBench bench(pocket_of(c.length, c.width, 0, 0.2));
        CHECK(bench.run(425, with(slot_block(), {{310, offset}, {301, via_clearance}})) == c.error);
        CHECK(bench.status() == c.status);
        check_q(bench, {{156, c.width}, {157, 80.2}, {166, c.width - 30}});
      }
    }
  }
  ProbingBench main(pocket_of(30, 60));
  CHECK(main.run(425, with(slot_block(), {{272, 1.0}})) == 0);
  CHECK(same(main.host.q[157], 100));
}

TEST_CASE("426: good, rework and reject of a ridge, from either end") {
  for (const Case& c : {Case{60, 30, 100, 0}, Case{60, 30.03, 100, 0}, Case{60, 29.97, 100, 0},
                        Case{60, 30.0301, 10, 1060}, Case{60, 29.9699, 1, 1061}}) {
    CAPTURE(c.width);
    for (const double first : {95.0, 65.0}) {
      ProbingBench bench(stud(c.length, c.width));
      CHECK(bench.run(426, with(ridge_block(), {{264, first}, {266, 160 - first}})) == c.error);
      CHECK(bench.status() == c.status);
      check_q(bench, {{156, c.width}, {157, 80}});
    }
  }
}

}  // namespace fitgauge::probing

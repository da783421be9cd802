#include <doctest/doctest.h>

#include "nc/machine/machine_setup.hpp"
#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::CoordinateSystem;
using machine::Setup;
using machine::Vec3;

/// A lathe tool 0.03 mm too short and 0.02 mm too near the axis, and a cuboid.
Setup lathe_setup(int orientation = 1, double rs = 0.8, double ori = 0) {
  Setup setup;
  machine::ToolSetup tool;
  tool.row.number = 11;
  tool.row.lathe =
      machine::LatheTool{.zl = 100, .xl = -40, .rs = rs, .orientation = orientation, .ori = ori};
  tool.actual_length = 99.97;
  tool.actual_xl = -39.98;
  setup.machine.tools.push_back(tool);
  setup.machine.tt.known.shape = machine::ContactPlate::Cube;
  return setup;
}

class LatheBench : public ProbingBench {
 public:
  explicit LatheBench(const Setup& setup = lathe_setup()) : ProbingBench(setup) { call(11); }

  const machine::Tool& tool() { return *machine.state().tools.find(11); }
  const machine::LatheTool& lathe() { return *tool().lathe; }
};

Values order(double mode) { return {{340, mode}, {260, 200.0}}; }

}  // namespace

TEST_CASE("485 finds the tip of every TO, with the spindle at ORI") {
  for (const int to : {0, 1, 2, 6, 7, 8, 9}) {
    for (const double rs : {0.0, 0.8, 9.0}) {
      for (const double ori : {0.0, 90.0, -123.0}) {
        CAPTURE(to);
        CAPTURE(rs);
        CAPTURE(ori);
        LatheBench bench(lathe_setup(to, rs, ori));
        CHECK(bench.run(485, order(1)) == 0);
        CHECK(same(bench.lathe().dzl, -0.03));
        CHECK(same(bench.lathe().dxl, 0.02));
        CHECK(bench.machine.state().modes.spindle_deg == ori);
        // With DZL and DXL in force the same tool is found again.
        CHECK(bench.run(485, order(1)) == 0);
        CHECK(same(bench.lathe().dzl, -0.03));
        CHECK(same(bench.lathe().dxl, 0.02));
        CHECK(std::abs(bench.machine.position(CoordinateSystem::Machine).linear.z - 200) < 1e-9);
      }
    }
  }
}

TEST_CASE("a first measurement of 485 finds a tool far from its row, beside the cuboid too") {
  Setup setup = lathe_setup();
  setup.machine.tools.back().row.lathe->zl = 96;
  setup.machine.tools.back().row.lathe->xl = -43;
  setup.machine.tools.back().row.lathe->dzl = 0.5;
  LatheBench bench(setup);
  CHECK(bench.run(485, order(0)) == 0);
  CHECK(same(bench.lathe().zl, 99.97));
  CHECK(same(bench.lathe().xl, -39.98));
  CHECK(bench.lathe().dzl == 0);
  CHECK(bench.host.q[199] == 0);
}

TEST_CASE("485: wear and breakage count for both lengths, and only a check locks") {
  struct Case {
    double tolerance;
    double breakage;
    double mode;
    int status;
    bool locked;
  };
  for (const Case& c :
       {Case{0.03, 0, 1, 0, false}, Case{0.0299, 0, 1, 1, true}, Case{0.0299, 0, 2, 1, false},
        Case{0.01, 0.0299, 1, 2, true}, Case{0.01, 0.02, 0, 0, false}, Case{0, 0, 1, 0, false}}) {
    CAPTURE(c.tolerance);
    CAPTURE(c.mode);
    Setup setup = lathe_setup();
    setup.machine.tools.back().row.l_tolerance = c.tolerance;
    setup.machine.tools.back().row.l_breakage = c.breakage;
    LatheBench bench(setup);
    const machine::Tool before = bench.tool();
    CHECK(bench.run(485, order(c.mode)) == 0);
    check_q(bench, {{115, -0.03}, {116, 0.02}});
    CHECK(bench.host.q[199] == c.status);
    CHECK(bench.tool().locked == c.locked);
    if (c.mode == 2) CHECK(bench.tool() == before);
  }
  Setup thin = lathe_setup();
  thin.machine.tools.back().actual_length = 100;
  thin.machine.tools.back().row.l_tolerance = 0.0199;  // only XL is beyond it
  LatheBench bench(thin);
  CHECK(bench.run(485, order(2)) == 0);
  CHECK(bench.host.q[199] == 1);
}

TEST_CASE("485: errors of mode, tool and tip") {
  LatheBench bench;
  CHECK(bench.run(485, order(3)) == 1004);
  for (const int cycle : {481, 482, 483}) CHECK(bench.run(cycle, order(1)) == 1093);
  for (const int up : {3, 4, 5}) {
    LatheBench pointing_up(lathe_setup(up));
    CHECK(pointing_up.run(485, order(1)) == 1109);
  }
}

TEST_CASE("the setup of a lathe tool contradicts L, R, a probe and a TO that there is not") {
  for (const auto& spoil :
       {+[](machine::ToolSetup& t) { t.row.l = 1; }, +[](machine::ToolSetup& t) { t.row.r = 1; },
        +[](machine::ToolSetup& t) { t.row.dr = 1; },
        +[](machine::ToolSetup& t) { t.actual_radius = 1; },
        +[](machine::ToolSetup& t) { t.row.probe = 1; },
        +[](machine::ToolSetup& t) { t.row.lathe->orientation = 10; },
        +[](machine::ToolSetup& t) { t.row.lathe.reset(); },
        +[](machine::ToolSetup& t) { t.row.lathe->rs = -1; }}) {
    Setup setup = lathe_setup();
    CHECK(validate(setup).has_value());
    spoil(setup.machine.tools.back());
    CHECK(validate(setup).has_error());
  }
}

}  // namespace fitgauge::probing

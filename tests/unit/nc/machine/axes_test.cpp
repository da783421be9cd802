#include "nc/machine/axes.hpp"

#include <doctest/doctest.h>

#include "nc/machine/machine.hpp"
#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;
using fitgauge::Allowance;

namespace {

/// Axes that write down where they are told to go, come to rest 0.02 mm beyond a contact, and fail
/// as a test wants.
class RecordingAxes final : public Axes {
 public:
  AxesCapabilities capabilities() const override { return able; }
  Position nose() const override { return stands; }
  MachineResult<double> follow(const Path& path, const Motion&) override {
    check_near(path.start.linear, stands.linear);
    if (fault) {
      stands = path.nose(0.5);
      return make_fault(*fault);
    }
    ways.push_back(path.end.linear);
    stands = path.end;
    return 1;
  }
  MachineResult<Position> probe(const Vec3& direction, double distance, const Motion&) override {
    if (fault) return make_fault(*fault);
    const Position contact{stands.linear + direction * (distance / 2), stands.rotary};
    stands.linear = contact.linear + direction * 0.02;
    return contact;
  }
  MachineResult<void> dwell(double, Allowance&) override {
    return fault ? MachineResult<void>(make_fault(*fault)) : MachineResult<void>();
  }
  void stop(std::string_view) override {}

  AxesCapabilities able;
  std::optional<FaultKind> fault;
  Position stands;
  std::vector<Vec3> ways;
};

struct Bench {
  Bench() : control(MachineSetup{}, std::unique_ptr<Axes>(axes)) {
    REQUIRE(control.call_tool({.number = 30, .axis = Axis::Z, .spindle_rpm = {}}).has_value());
  }
  RecordingAxes* axes = new RecordingAxes;  // the control's
  Machine control;
};

ProbeMove towards_x(std::optional<double> retract = std::nullopt) {
  return {{1, 0, 0}, 10, 100, CoordinateSystem::Input, retract, Feed::rapid()};
}

}  // namespace

TEST_CASE("axes that follow no curve are given straight pieces") {
  Bench bench;
  const Vec3 start = bench.control.position().linear;
  const ArcMove arc{start + Vec3{-10, 10, 3}, start + Vec3{-10, 0, 0}, 90, Axis::Z, Feed::at(500)};
  REQUIRE(bench.control.move_arc(arc).has_value());
  CHECK(bench.axes->ways.size() == 1);

  Bench straight;
  straight.axes->able.curves = false;
  REQUIRE(straight.control.move_arc(arc).has_value());
  const std::vector<Vec3>& ways = straight.axes->ways;
  CHECK(ways.size() >= 8);
  CHECK(ways.size() < 200);
  Vec3 before;
  for (const Vec3& way : ways) {
    const Vec3 middle = (before + way) * 0.5 - Vec3{-10, 0, 0};
    CHECK(std::abs(std::hypot(middle.x, middle.y) - 10) < 1e-3);
    CHECK(std::abs(std::hypot(way.x + 10, way.y) - 10) < 1e-9);
    before = way;
  }
  check_near(straight.control.position().linear, arc.end);
}

TEST_CASE("what is measured is the contact, and the way back begins where the axes came to rest") {
  Bench bench;
  const Vec3 start = bench.axes->stands.linear;
  const auto found = bench.control.probe(towards_x());
  REQUIRE(found.has_value());
  check_near(found->nose.linear, start + Vec3{5, 0, 0});
  check_near(bench.axes->ways.at(0), start);
  check_near(bench.control.state().nose.linear, start);
  const auto partly = bench.control.probe(towards_x(2));
  REQUIRE(partly.has_value());
  check_near(bench.axes->ways.at(1), start + Vec3{3, 0, 0});
}

TEST_CASE("what only a machine can say ends the command, and the next one begins where it stands") {
  for (const FaultKind kind : {FaultKind::EmergencyStop, FaultKind::FeedHold, FaultKind::Aborted,
                               FaultKind::ConnectionLost}) {
    Bench bench;
    bench.axes->fault = kind;
    const LinearMove move{AxisWords::linear({1, 2, 3}), Feed::rapid(), CoordinateSystem::Machine};
    CHECK(bench.control.move(move).error().kind == kind);
    CHECK(norm(bench.axes->stands.linear) > 1);
    check_near(bench.control.state().nose.linear, bench.axes->stands.linear);
    CHECK(bench.control.probe(towards_x()).error().kind == kind);
    CHECK(bench.control.dwell(1).error().kind == kind);
    bench.axes->fault.reset();
    CHECK(bench.control.move(move).has_value());
  }
}

TEST_CASE("axes without a probe input refuse to probe") {
  Bench bench;
  bench.axes->able.probes = false;
  CHECK(bench.control.probe(towards_x()).error().kind == FaultKind::OptionMissing);
}

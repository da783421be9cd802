#include "nc/machine/scripted_machine.hpp"

#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

namespace {

/// With the ball's centre at the origin.
void stand_at_origin(Machine& machine) {
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({0, 0, -2}))));
}

}  // namespace

TEST_CASE("recorded contacts are replayed in order") {
  ScriptedMachine machine(MachineSetup{}, {{Vec3{10.5, 0.01, 0}}, {std::nullopt}, {Vec3{0, 9, 0}}});
  stand_at_origin(machine);
  const auto first = machine.probe(towards({1, 0, 0}));
  REQUIRE(ok(first));
  check_near(first->ball_centre, {10.5, 0, 0});
  check_near(first->surface, {12.5, 0, 0});
  CHECK(fault_of(machine.probe(towards({0, 0, 1}))) == FaultKind::NoContact);
  CHECK(machine.remaining() == 1);
  stand_at_origin(machine);
  CHECK(fault_of(machine.probe(towards({1, 0, 0}))) == FaultKind::ScriptedDifferent);
  CHECK(fault_of(machine.probe(towards({1, 0, 0}))) == FaultKind::ScriptExhausted);
}

TEST_CASE("the contacts of a simulated run give the same run again") {
  Setup setup;
  setup.features = {Block{{-30, -30, -40}, {30, 30, 20}}, Bore{{0, 0}, 20, 40, 25.013}};
  SimulatedMachine simulated(setup);
  stand_at_origin(simulated);
  std::vector<ScriptedContact> log;
  std::vector<ContactPoint> found;
  const std::vector<Vec3> directions{{1, 0, 0}, {1, 2, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const Vec3& direction : directions) {
    found.push_back(simulated.probe(towards(direction)).value());
    log.push_back({found.back().ball_centre});
  }
  ScriptedMachine scripted(setup.machine, log);
  stand_at_origin(scripted);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const auto contact = scripted.probe(towards(directions[k]));
    REQUIRE(ok(contact));
    check_near(contact->surface, found[k].surface);
  }
  CHECK(scripted.state().elapsed_s == doctest::Approx(simulated.state().elapsed_s));
}

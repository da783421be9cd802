#include "nominal_parts.hpp"

namespace fitgauge::probing {

TEST_CASE("every cycle that touches the workpiece has a part equal to its drawing") {
  std::set<int> covered;
  for (const NominalCase& c : nominal_cases()) covered.insert(c.cycle);
  for (const TouchProbeCycle* cycle : cycles()) {
    const CycleDescriptor& descriptor = cycle->descriptor;
    const bool touches = descriptor.kind == CycleKind::Measuring ||
                         descriptor.kind == CycleKind::Preset ||
                         descriptor.kind == CycleKind::Alignment;
    if (!touches || descriptor.number == 247 || descriptor.number == 404) continue;  // no motion
    CAPTURE(descriptor.number);
    CHECK(covered.contains(descriptor.number));
  }
}

TEST_CASE("a part equal to its drawing gives the nominal values in every cycle") {
  for (const NominalCase& c : nominal_cases()) {
    CAPTURE(c.cycle);
    const Outcome outcome = run_in(c, {}, {});
    CHECK(outcome.error == 0);
    std::vector<double> nominal;
    for (const auto& result : c.results) nominal.push_back(result.second);
    if (c.touched) nominal.push_back(c.touched->second);
    nominal.push_back(0);  // the basic rotation
    REQUIRE(outcome.values.size() == nominal.size());
    for (const double datum : outcome.stored) CHECK(datum == 0);
    for (std::size_t k = 0; k < nominal.size(); ++k) {
      CAPTURE(k);
      CHECK(std::abs(outcome.values[k] - nominal[k]) < 1e-9);
    }
  }
}

}  // namespace fitgauge::probing

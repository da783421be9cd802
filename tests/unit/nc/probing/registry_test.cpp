#include <doctest/doctest.h>

#include "nc/probing/cycles.hpp"

namespace fitgauge::probing {

TEST_CASE("every cycle is found by its family and number") {
  CHECK_FALSE(cycles().empty());
  std::set<std::pair<CycleFamily, int>> numbers;
  for (const TouchProbeCycle* cycle : cycles()) {
    const CycleDescriptor& descriptor = cycle->descriptor;
    CAPTURE(descriptor.number);
    CHECK(numbers.emplace(descriptor.family, descriptor.number).second);
    CHECK(find_cycle(descriptor.family, descriptor.number) == cycle);
    CHECK((cycle->execute != nullptr));
    CHECK_FALSE(descriptor.name.empty());
    CHECK_FALSE(descriptor.simulated.empty());
  }
  CHECK(find_cycle(CycleFamily::CyclDef, 421) == nullptr);
  CHECK(find_cycle(CycleFamily::TchProbe, 584) == nullptr);
}

TEST_CASE("parameters are unique in their cycle, have a meaning and a default they accept") {
  for (const TouchProbeCycle* cycle : cycles()) {
    CAPTURE(cycle->descriptor.number);
    std::set<ParameterId> ids;
    for (const CycleParameter& parameter : cycle->descriptor.parameters) {
      CAPTURE(name(parameter));
      CHECK(ids.insert(parameter.id).second);
      CHECK_FALSE(parameter.meaning.empty());
      CHECK(is_word(parameter.id) == cycle->descriptor.dotted);
      if (!parameter.default_value) continue;
      CHECK(check(parameter, *parameter.default_value).has_value());
    }
    std::set<std::uint16_t> results;
    for (const CycleOutput& result : cycle->descriptor.results) {
      CHECK(results.insert(result.q).second);
      CHECK_FALSE(result.meaning.empty());
    }
  }
}

}  // namespace fitgauge::probing

#include "nc/probing/cycles.hpp"

#include <doctest/doctest.h>

namespace fitgauge::probing {
namespace {

constexpr std::array kParameters{
    CycleParameter{.id = q(262), .meaning = "Nominal diameter", .range = {0, 100}},
    CycleParameter{.id = q(301), .kind = ValueKind::Whole, .range = {0, 1}, .default_value = 0},
    CycleParameter{.id = q(253), .kind = ValueKind::NumberOrMax, .required = false},
    CycleParameter{.id = q(330), .kind = ValueKind::NumberOrText, .default_value = 0},
    CycleParameter{.id = q(400), .kind = ValueKind::Text, .required = false}};
const CycleDescriptor kDescriptor{.number = 421, .name = "TEST", .parameters = kParameters};

int error_of(ParameterId id, const ArgumentValue& value) {
  const auto checked = check(*kDescriptor.find(id), value);
  return checked ? 0 : checked.error().number;
}

}  // namespace

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

TEST_CASE("missing parameters take their default, required ones are an error") {
  Arguments arguments(kDescriptor);
  const auto missing = arguments.complete();
  REQUIRE(missing.has_error());
  CHECK(missing.error() == CycleFault{machine::FaultKind::Error, 1017,
                                      "CYCL incomplete: Q262 Nominal diameter is missing"});
  arguments.set(q(262), 25.0);
  REQUIRE(arguments.complete().has_value());
  CHECK(arguments.number(262) == 25.0);
  CHECK(arguments.whole(301) == 0);
  CHECK_FALSE(arguments.has_number(q(253)));
  CHECK(arguments.text(q(400)) == nullptr);
}

TEST_CASE("a value outside the range or of the wrong kind is an error") {
  CHECK(error_of(q(262), 0.0) == 0);
  CHECK(error_of(q(262), 100.0) == 0);
  CHECK(error_of(q(262), 100.0001) == 1004);
  CHECK(error_of(q(262), std::numeric_limits<double>::quiet_NaN()) == 1011);
  CHECK(error_of(q(262), std::string("25")) == 1011);
  CHECK(error_of(q(301), 0.5) == 1011);
  CHECK(error_of(q(253), std::numeric_limits<double>::infinity()) == 0);
  CHECK(error_of(q(330), std::string("MILL_D16")) == 0);
  CHECK(error_of(q(400), 0.1) == 1011);
}

TEST_CASE("error texts are the control's") {
  CHECK(error_text(1000) == "Spindle?");
  CHECK(error_text(1014) == "Touch point inaccessible");
  CHECK(error_text(1065) == "Tool breakage tolerance exceeded");
  CHECK(error_text(1109) == "Tool data inconsistent");
  CHECK(error_text(999).empty());
  CHECK(error_text(1110).empty());
}

}  // namespace fitgauge::probing

#include "gauging/reference_temperature.hpp"

#include <doctest/doctest.h>

#include "base/length.hpp"

using namespace fitgauge;
using namespace fitgauge::gauging;

namespace {

constexpr ThermalBody at(std::int64_t degrees, std::int64_t expansion) {
  return {.temperature = degrees * 1'000'000, .expansion = expansion * 100'000};
}

TEST_CASE("a warm part is smaller at 20 degrees, and a warm scale reads too little") {
  const Length reading = Length::millimetres(100);
  // 100 mm / (1 + 11.5e-6 * 10) = 99.98850132..., worked out with 50 digits.
  CHECK(size_at_20_degrees(reading, at(30, 115), {}) == Length::nanometres(99'988'501));
  CHECK(size_at_20_degrees(reading, at(10, 115), {}) == Length::nanometres(100'011'501));
  CHECK(size_at_20_degrees(reading, {}, at(30, 80)) == Length::nanometres(100'008'000));
  // Part and scale alike: nothing changes.
  CHECK(size_at_20_degrees(reading, at(35, 115), at(35, 115)) == reading);
  // By division: to first order it would be 100 - 0.23 * 60 / 1000 ... 1.9 µm off.
  CHECK(size_at_20_degrees(reading, at(80, 230), {}) == Length::nanometres(99'862'190));
  CHECK(size_at_20_degrees(reading, at(20, 230), {}) == reading);
}

TEST_CASE("the ends of what a body may be stay within the numbers") {
  const Length largest = Length::millimetres(100'000'000);
  const ThermalBody hot{.temperature = kHottest, .expansion = kLargestExpansion};
  const ThermalBody cold{.temperature = kColdest, .expansion = kLargestExpansion};
  CHECK(size_at_20_degrees(largest, hot, hot) == largest);
  CHECK(size_at_20_degrees(largest, cold, hot) > largest);
  CHECK(size_at_20_degrees(Length::nanometres(1), hot, cold) == Length());
}

TEST_CASE("materials have a name of their own and a source") {
  for (const Material& material : materials()) {
    CHECK(expansion_of(material.name) == material.expansion);
    CHECK_FALSE(material.source.empty());
  }
  CHECK_FALSE(expansion_of("wood"));
}

}  // namespace

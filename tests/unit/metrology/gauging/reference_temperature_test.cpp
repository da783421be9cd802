#include "metrology/gauging/gauge.hpp"

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

TEST_CASE("what a correction adds is what the Guide has for an end gauge") {
  // JCGM 100:2008, H.1: 50 mm, 11.5e-6/K known to ±1e-6/K, 0.1 K below 20 °C known to ±0.05 K, both
  // rectangular: the two contributions are 2.9 nm and 16.6 nm (table H.1).
  const Length gauge = Length::nanometres(50'000'838);
  ThermalBody part{.temperature = 19'900'000, .expansion = 11'500'000};
  CHECK(added_uncertainty(gauge, part, {}) == 0);
  part.expansion_uncertainty = 577'350;
  CHECK(added_uncertainty(gauge, part, {}) == 2887);
  part.expansion_uncertainty = 0;
  part.temperature_uncertainty = 28'868;
  CHECK(added_uncertainty(gauge, part, {}) == 16'599);
  part.expansion_uncertainty = 577'350;
  CHECK(added_uncertainty(gauge, part, {}) == 16'849);
  // The scale counts alike, and both together as the root of the squares.
  CHECK(added_uncertainty(gauge, {}, part) == 16'849);
  CHECK(added_uncertainty(gauge, part, part) == 23'827);
  // Not the Guide's: at 20 °C an unknown expansion matters to nothing.
  part.temperature = 20'000'000;
  CHECK(added_uncertainty(gauge, part, {}) == 16'599);
}

TEST_CASE("what is added has no more digits than a number of JSON keeps") {
  const ThermalBody part{.temperature = kColdest,
                         .expansion = kLargestExpansion,
                         .temperature_uncertainty = 999'999'983};
  const std::int64_t added = added_uncertainty(Length::nanometres(99'999'999'123'457), part, {});
  CHECK(added > 100'000'000'000'000'000);
  CHECK(added % 1000 == 0);
}

TEST_CASE("the sensitivities are those of the correction") {
  const Length reading = Length::millimetres(1'000'000);
  const ThermalBody part{.temperature = 80'000'000, .expansion = 23'000'000};
  const ThermalBody scale{.temperature = -20'000'000, .expansion = 8'000'000};
  const Length size = size_at_20_degrees(reading, part, scale);
  // By how much the size changes with a small step of one input, in pm.
  const auto step = [&](auto&& change) {
    ThermalBody other_part = part;
    ThermalBody other_scale = scale;
    change(other_part, other_scale);
    const Length difference = size_at_20_degrees(reading, other_part, other_scale) - size;
    return std::abs(static_cast<double>(difference.count())) * 1000;
  };
  const auto added = [&](auto&& change) {
    ThermalBody of_part = part;
    ThermalBody of_scale = scale;
    change(of_part, of_scale);
    return doctest::Approx(static_cast<double>(added_uncertainty(size, of_part, of_scale)))
        .epsilon(1e-4);
  };
  CHECK(step([](auto& p, auto&) { p.temperature += 1000; }) ==
        added([](auto& p, auto&) { p.temperature_uncertainty = 1000; }));
  CHECK(step([](auto& p, auto&) { p.expansion += 1000; }) ==
        added([](auto& p, auto&) { p.expansion_uncertainty = 1000; }));
  CHECK(step([](auto&, auto& s) { s.temperature += 1000; }) ==
        added([](auto&, auto& s) { s.temperature_uncertainty = 1000; }));
  CHECK(step([](auto&, auto& s) { s.expansion += 1000; }) ==
        added([](auto&, auto& s) { s.expansion_uncertainty = 1000; }));
}

TEST_CASE("uncertainties are combined exactly and rounded up") {
  const auto combined = [](std::int64_t u_nm, std::int64_t added_pm) {
    return combined_uncertainty(Length::nanometres(u_nm), added_pm).count();
  };
  CHECK(combined(300, 400'000) == 500);
  CHECK(combined(300, 400'001) == 501);
  CHECK(combined(300, 399'999) == 500);
  CHECK(combined(800, 0) == 800);
  CHECK(combined(0, 1) == 1);
  CHECK(combined(0, 1000) == 1);
  CHECK(combined(0, 1001) == 2);
  // The ends: what a measurement without limits has, and what a foreign record may say.
  CHECK(combined_uncertainty(kLongest, 1).count() == kLongest.count() + 1);
  CHECK(combined_uncertainty(kLongest + kLongest, 1) == kLongest + kLongest);
  CHECK(combined_uncertainty(Length(), std::numeric_limits<std::int64_t>::max()) == kLongest);
  CHECK(combined_uncertainty(Length::nanometres(5), -7) == Length::nanometres(5));
}

TEST_CASE("what a budget comes to is rounded up to the nanometre, without the noise of binaries") {
  CHECK(rounded_up(0.5) == Length::nanometres(500));
  CHECK(rounded_up(0.1 + 0.2) == Length::nanometres(300));
  CHECK(rounded_up(0.3000001) == Length::nanometres(301));
  CHECK(rounded_up(0) == Length());
  CHECK(rounded_up(2.5e6) == Length::millimetres(2500));
  CHECK_FALSE(rounded_up(-1).has_value());
  CHECK_FALSE(rounded_up(1e300).has_value());
  CHECK_FALSE(rounded_up(std::numeric_limits<double>::quiet_NaN()).has_value());
}

TEST_CASE("materials have a name of their own and a source") {
  for (const Material& material : materials()) {
    CHECK(find_material(material.name) == &material);
    CHECK_FALSE(material.source.empty());
  }
  CHECK(find_material("wood") == nullptr);
}

}  // namespace

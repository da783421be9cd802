#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;
using machine::Bore;
using machine::Boss;
using machine::Feature;

Boss boss(double x, double diameter) {
  return {.centre = {x, 80}, .top = 10, .height = 10, .diameter = diameter};
}
Bore bore(double x, double diameter) {
  return {.centre = {x, 80}, .top = 0, .depth = 30, .diameter = diameter};
}
const std::vector<Feature> kBosses{kPlate, boss(50, 12), boss(150, 12)};
const std::vector<Feature> kBores{kPlate, bore(50, 12), bore(150, 12)};
const std::vector<Feature> kBlock{Block{{70, 60, -40}, {130, 100, 0}}};

/// The part that the error of a cycle names, and its remedy.
std::string part(const std::vector<Feature>& features, int cycle, const Values& values) {
  ProbingBench bench(features);
  if (bench.run(cycle, values) == 0) return "no error";
  const auto at = bench.fault.text.find("the setup has a ");
  return at == std::string::npos ? bench.fault.text : bench.fault.text.substr(at + 16);
}

}  // namespace

TEST_CASE("an error names the part that is there and the cycle for its side") {
  const Values two{{268, 50.0}, {269, 80.0}, {270, 150.0}, {271, 80.0}, {260, 40.0}};
  const Values studs{{313, 12.0}, {314, 12.0}, {315, -5.0}, {261, -5.0}};
  CHECK(part(kBosses, 401, with(two, {{261, 5.0}})) == "boss of 12 mm here: cycle 402");
  CHECK(part(kBores, 402, with(two, studs)) == "bore of 12 mm here: cycle 401");

  const Values rectangle{{261, -5.0}, {260, 30.0}};
  const Values measured = with(rectangle, {{273, 100.0}, {274, 80.0}, {282, 60.0}, {283, 40.0}});
  const Values preset = with(rectangle, {{321, 100.0}, {322, 80.0}, {323, 60.0}, {324, 40.0}});
  const std::string block = "boss of 60 x 40 mm here: cycle ";
  const std::string pocket = "pocket of 60 x 40 mm here: cycle ";
  CHECK(part(kBlock, 423, measured) == block + "424");
  CHECK(part(kPocket, 424, measured) == pocket + "423");
  CHECK(part(kBlock, 410, preset) == block + "411");
  CHECK(part(kPocket, 411, preset) == pocket + "410");

  const Values width = with(rectangle, {{272, 2.0}, {311, 40.0}});
  const Values centre = with(width, {{321, 100.0}, {322, 80.0}});
  CHECK(part(kBlock, 408, centre) == block + "409");
  CHECK(part(kPocket, 409, centre) == pocket + "408");
  CHECK(part(kBlock, 425, with(width, {{328, 100.0}, {329, 80.0}})) == block + "426");
  CHECK(part(kPocket, 426, with(width, {{263, 100.0}, {264, 100.0}, {265, 100.0}, {266, 60.0}})) ==
        pocket + "425");
  const std::vector<Feature> walls{kPocket[2], kPocket[3]};
  CHECK(part(walls, 409, centre) == "slot of 40 mm here: cycle 408");
  // Another size is another part.
  CHECK(part(kBlock, 408, with(centre, {{311, 8.0}})).find("boss") == std::string::npos);

  const Values object = values("1100=100 1101=80 1102=-5 260=40 1113=40 1114=90");
  CHECK(part(kBlock, 1404, object) == "boss of 60 x 40 mm here: Q1115 = 1");
  CHECK(part(kPocket, 1434, with(object, {{1115, 1.0}})) == "pocket of 60 x 40 mm here: Q1115 = 0");

  const Values circle{{1100, 50.0}, {1101, 80.0}, {260, 40.0}, {1116, 12.0}};
  CHECK(part(kBosses, 1401, with(circle, {{1102, 5.0}})) == "boss of 12 mm here: Q1115 = 1");
  CHECK(part(kBores, 1401, with(circle, {{1102, -5.0}, {1115, 1.0}})) ==
        "bore of 12 mm here: Q1115 = 0");
  const std::vector<Feature> both{kPlate, bore(50, 12), boss(150, 12)};
  const Values mixed = with(circle, values("1102=-5 1103=150 1104=80 1105=5 1117=12"));
  CHECK(part(both, 1411, mixed) == "boss of 12 mm here: Q1115 = 2");
  CHECK(part(both, 1411, with(mixed, {{1115, 1.0}})) == "bore of 12 mm here: Q1115 = 2");
  CHECK(part(both, 1411, with(mixed, {{1115, 2.0}})) == "no error");
}

TEST_CASE("a fault carries the kind of the machine's fault, and none of its own") {
  const Values two{{268, 50.0}, {269, 80.0}, {270, 150.0}, {271, 80.0}, {260, 40.0}};
  ProbingBench bosses(kBosses);
  CHECK(bosses.run(401, with(two, {{261, 5.0}})) == -1);
  CHECK(bosses.fault.kind == machine::FaultKind::Collision);
  ProbingBench bores(kBores);
  CHECK(bores.run(401, with(two, {{261, -5.0}, {270, 50.0}})) == 1081);
  CHECK(bores.fault.kind == machine::FaultKind::Error);
}

}  // namespace fitgauge::probing

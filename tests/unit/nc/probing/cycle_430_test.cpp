#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

/// Three holes of 10 mm on a circle of the given diameter around 100, 80.
std::vector<machine::Feature> holes(double diameter, double dx = 0) {
  std::vector<machine::Feature> features{machine::Block{.min = {0, 0, -40}, .max = {200, 200, 0}}};
  for (const double angle : {0.0, 120.0, 240.0}) {
    const auto [sine, cosine] = machine::sine_cosine(angle);
    features.push_back(
        machine::Bore{.centre = {100 + dx + diameter / 2 * cosine, 80 + diameter / 2 * sine},
                      .top = 0,
                      .depth = 20,
                      .diameter = 10});
  }
  return features;
}

Values bolt_block() {
  return {{273, 100.0}, {274, 80.0}, {262, 60.0},  {291, 0.0},   {292, 120.0}, {293, 240.0},
          {261, -5.0},  {260, 20.0}, {288, 60.05}, {289, 59.95}, {309, 1.0}};
}

}  // namespace

TEST_CASE("430: centre, breakage and errors") {
  machine::Setup setup{.machine = {}, .features = holes(60.02, 0.1)};
  setup.machine.tools.push_back(tool_of(7, 80, 5));
  setup.machine.tools.back().row.r_breakage = 0.01;
  ProbingBench bench(setup);
  CHECK(bench.run(430, with(bolt_block(), {{279, 0.1}})) == 0);
  CHECK(bench.run(430, with(bolt_block(), {{279, 0.09}})) == 1044);
  CHECK(bench.run(430, with(bolt_block(), {{330, 7.0}})) == 1065);
  CHECK(bench.machine.state().tools.find(7)->dr == 0);
  CHECK(bench.machine.state().tools.find(7)->locked);
  CHECK(bench.run(430, with(bolt_block(), {{262, 80.0}})) == -1);
}

}  // namespace fitgauge::probing

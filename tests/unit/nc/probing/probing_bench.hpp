#pragma once

#include <doctest/doctest.h>

#include <sstream>

#include "nc/machine/simulated_machine.hpp"
#include "nc/probing/cycles.hpp"
#include "recording_host.hpp"

namespace fitgauge::probing {

/// The values of a block by the numbers of its Q parameters; later ones win.
using Values = std::vector<std::pair<int, ArgumentValue>>;

/// The key of a word of a dotted cycle in Values.
constexpr int word(ParameterId id) { return static_cast<int>(id); }

inline Values with(Values values, const Values& changes) {
  values.insert(values.end(), changes.begin(), changes.end());
  return values;
}

/// The words of the dotted cycles in values(), as ParameterId has them.
inline constexpr std::array<std::string_view, 12> kWords{
    "result", "axis",     "direction", "X",       "Y",      "Z",
    "angle",  "distance", "feed",      "retract", "system", "error-mode"};

inline int key_of(const std::string& name) {
  const auto found = std::ranges::find(kWords, name);
  if (found != kWords.end())
    return word(ParameterId::WordResult) + static_cast<int>(found - kWords.begin());
  std::size_t end = 0;
  const int parameter = std::stoi(name, &end);
  if (end != name.size()) throw std::invalid_argument(name);
  return parameter;
}

/// Parameters, each once, and numbers as "273=100 274=80"; any other text throws, which fails the
/// case.
inline Values values(const std::string& text) {
  Values all;
  std::istringstream in(text);
  for (std::string name; std::getline(in >> std::ws, name, '=');) {
    double value = 0;
    const int key = key_of(name);
    const bool is_first = std::ranges::count(all, key, &Values::value_type::first) == 0;
    if (!(in >> value) || !is_first) throw std::invalid_argument(text);
    all.emplace_back(key, value);
  }
  return all;
}

inline const machine::Block kPlate{{0, 0, -40}, {200, 160, 0}};
/// The plate with a rectangular hole between these places.
inline std::vector<machine::Feature> pocket(double x1, double y1, double x2, double y2) {
  return {machine::Block{{0, 0, -40}, {x1, 160, 0}}, machine::Block{{x2, 0, -40}, {200, 160, 0}},
          machine::Block{{x1, 0, -40}, {x2, y1, 0}}, machine::Block{{x1, y2, -40}, {x2, 160, 0}}};
}
/// 60 by 40 mm around (100, 80) of the plate.
inline const std::vector<machine::Feature> kPocket = pocket(70, 60, 130, 100);

/// Material beyond an edge 30 mm from the zero, at an angle to the main axis.
inline machine::Plane edge_at(double angle_deg) {
  const auto [sine, cosine] = machine::sine_cosine(angle_deg);
  const machine::Vec3 normal{sine, -cosine, 0};
  return {.point = normal * -30, .normal = normal};
}

/// A tool as long and as thick as its row of the tool table says.
inline machine::ToolSetup tool_of(int number, double length, double radius) {
  machine::ToolSetup tool;
  tool.row.number = number;
  tool.row.l = length;
  tool.row.r = radius;
  return tool;
}

/// A simulated machine with the probe of the default setup (ball radius 2 mm, SET_UP 2, DIST 20) in
/// the spindle, and a workpiece; cycles run on it one after the other.
class ProbingBench {
 public:
  explicit ProbingBench(std::vector<machine::Feature> features = {})
      : ProbingBench(machine::Setup{.machine = {}, .features = std::move(features)}) {}
  explicit ProbingBench(const machine::Setup& setup) : machine(setup) { call(30); }

  void call(int number, machine::Axis axis = machine::Axis::Z) {
    REQUIRE(machine.call_tool({.number = number, .axis = axis, .spindle_rpm = {}}).has_value());
  }

  const machine::PresetFrame& preset(int row) const {
    const machine::Preset* found = machine.state().presets.find(row);
    REQUIRE(found != nullptr);
    return found->frame;
  }

  /// Writes row 2, with a basic rotation alone, and activates it.
  void activate_turned_preset(double degrees) {
    machine::Preset turned{.number = 2, .comment = {}, .frame = {}};
    turned.frame.basic_rotation_deg = {0, 0, degrees};
    REQUIRE(machine.write_preset(turned).has_value());
    REQUIRE(machine.activate_preset(2).has_value());
  }

  /// One axis, with the others where they are.
  void move(machine::Axis axis, double target) {
    machine::AxisWords words;
    words[axis] = target;
    REQUIRE(machine.move({words, {}}).has_value());
  }

  /// Error number and text; 0 when the cycle succeeds, -1 for a fault without a number.
  int run(int number, const Values& values, CycleFamily family = CycleFamily::TchProbe) {
    const TouchProbeCycle* cycle = find_cycle(family, number);
    REQUIRE(cycle != nullptr);
    Arguments arguments(cycle->descriptor);
    for (const auto& [parameter, value] : values) {
      CAPTURE(parameter);
      REQUIRE(cycle->descriptor.find(q(parameter)) != nullptr);
      arguments.set(q(parameter), value);
    }
    const auto result = run_cycle(*cycle, std::move(arguments), machine, host);
    if (result) return 0;
    fault = result.error();
    return fault.number == 0 ? -1 : fault.number;
  }

  /// Q180, Q181, Q182 as one number: 100 good, 10 rework, 1 reject.
  int status() { return static_cast<int>(100 * host.q[180] + 10 * host.q[181] + host.q[182]); }

  machine::SimulatedMachine machine;
  RecordingHost host;
  CycleFault fault;  ///< of the last run that failed
};

/// The HTML log that a cycle wrote.
inline const std::string& log_of(ProbingBench& bench, int cycle) {
  return bench.host.files.at("TCHPR" + std::to_string(cycle) + ".html");
}

inline bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Equal as the control's 1 nm results are.
inline bool same(double a, double b) { return std::abs(a - b) < 5e-10; }

/// Checks Q parameters, as equal as the control's 1 nm results are.
inline void check_q(ProbingBench& bench, const std::vector<std::pair<int, double>>& expected) {
  for (const auto& each : expected) {
    CAPTURE(each.first);
    CAPTURE(each.second);
    const double deviation = bench.host.q[each.first] - each.second;
    CHECK(std::abs(deviation) < 5e-10);
  }
}

}  // namespace fitgauge::probing

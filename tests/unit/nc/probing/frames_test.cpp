#include <doctest/doctest.h>

#include "kinematics_bench.hpp"
#include "nominal_parts.hpp"

/// Every cycle in shifted, rotated, scaled and mirrored coordinates: the same results in its own
/// coordinates, or the control's error.
namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Frames;
using machine::Setup;
using machine::Vec3;

/// The errors of a cycle in frames that it does not work in; 0 where it does.
struct FrameRule {
  std::string_view reason;
  int mirrored;
  int scaled;
  int scaled_by_axis;
  std::vector<int> cycles;
};

const std::vector<FrameRule> kRules{
    {"a touch along a direction of the input system", 0, 0, 0, {3, 4}},
    {"a circle would be an ellipse",
     0,
     0,
     1108,
     {0, 1, 420, 421, 422, 423, 424, 425, 426, 427, 430, 431}},
    {"presets, basic rotations and probe data have no scale and no mirror",
     1008,
     1007,
     1007,
     {400, 401, 402, 403, 405, 408, 409,  410,  411,  412,  413,  414,  415,  416,  417,  418,
      419, 444, 460, 461, 462, 463, 1400, 1401, 1402, 1404, 1410, 1411, 1412, 1420, 1430, 1434}},
    {"the sphere lies in the preset, the tool touch probe in the machine",
     0,
     0,
     0,
     {30, 31, 32, 33, 451, 452, 453, 480, 481, 482, 483, 484, 485}},
    {"no motion", 0, 0, 0, {247, 404, 441, 450, 1493}},
};

struct NamedFrames {
  std::string_view name;
  int FrameRule::*error;  ///< null: every cycle works in them
  bool right_angles;
  Frames frames;
};

Frames frames_of(const Vec3& shift, double angle, const Vec3& factor,
                 const std::array<bool, 3>& mirrored = {}) {
  Frames frames;
  frames.set_datum_shift({shift, {}});
  frames.set_mirror(mirrored);
  frames.set_rotation({angle, Axis::Z});
  frames.set_scaling({factor, {}});
  return frames;
}

const std::vector<NamedFrames> kFrames{
    {"shifted", nullptr, true, frames_of({-50, 20, -10}, 0, {1, 1, 1})},
    {"at a right angle", nullptr, true, frames_of({30, -40, 5}, 90, {1, 1, 1})},
    {"rotated", nullptr, false, frames_of({}, 33, {1, 1, 1})},
    {"smaller", &FrameRule::scaled, true, frames_of({}, -90, {0.8, 0.8, 0.8})},
    {"rotated and smaller", &FrameRule::scaled, false, frames_of({}, 33, {0.9, 0.9, 0.9})},
    {"longer in X", &FrameRule::scaled_by_axis, true, frames_of({}, 0, {1.1, 1, 1})},
    {"longer in Y", &FrameRule::scaled_by_axis, true, frames_of({}, 0, {1, 1.1, 1})},
    {"longer in Z", &FrameRule::scaled_by_axis, true, frames_of({}, 0, {1, 1, 1.1})},
    {"mirrored", &FrameRule::mirrored, true, frames_of({20, 0, 0}, 0, {1, 1, 1}, {true})},
    {"mirrored and rotated", &FrameRule::mirrored, false,
     frames_of({0, 20, 0}, 33, {1, 1, 1}, {false, true})},
};

/// A cycle with what it works on; runs with frames active.
struct Scenario {
  int cycle;
  bool only_right_angles = false;
  std::function<Outcome(const Frames& frames)> run;
};

/// The frames' transformations within the active preset.
void transform(ProbingBench& bench, const Frames& transformations) {
  Frames frames = transformations;
  frames.set_preset(bench.machine.state().frames.preset());
  REQUIRE(bench.machine.set_frames(frames).has_value());
}

using Numbers = std::vector<double>;
using Read = std::function<Numbers(ProbingBench&)>;

Numbers probe_data(ProbingBench& bench) {
  const machine::ProbeSystem probe = *bench.machine.state().probe_system();
  return {probe.radius, probe.length, probe.data.cal_of1, probe.data.cal_of2};
}

Numbers tool_data(ProbingBench& bench) {
  const machine::ToolTouchProbe& tt = bench.machine.state().tt;
  const machine::Tool& tool = *bench.machine.state().active_tool();
  return {tt.centre.x, tt.centre.y, tt.centre.z, tt.radius, tool.dl, tool.dr, bench.host.q[199]};
}

Numbers lathe_data(ProbingBench& bench) {
  const machine::LatheTool& lathe = *bench.machine.state().active_tool()->lathe;
  return {lathe.dzl, lathe.dxl, bench.host.q[199]};
}

Numbers kinematic_results(ProbingBench& bench) {
  Numbers values;
  for (int q = 141; q <= 149; ++q) values.push_back(bench.host.q[q]);
  const Vec3 offset = bench.machine.state().kinematics.offset();
  values.insert(values.end(), {offset.x, offset.y, offset.z});
  return values;
}

Numbers modal_state(ProbingBench& bench) {
  const machine::MachineState& state = bench.machine.state();
  const Vec3 zero = state.frames.preset().origin;
  return {static_cast<double>(state.active_preset),
          zero.x,
          zero.y,
          zero.z,
          state.frames.preset().basic_rotation_deg.z,
          bench.host.memory().fast_probing.positioning_feed,
          static_cast<double>(bench.host.saved.size()),
          bench.host.memory().extrusion.value_or(Extrusion{}).step.x};
}

/// A probe and what it is calibrated against: none is as the tables say.
Setup calibration_setup() {
  Setup setup;
  setup.machine.tools[0].actual_radius = 1.9963;
  setup.machine.tools[0].actual_length = 120.25;
  setup.machine.probes[0].centre_offset = {0.013, -0.021};
  setup.machine.calibration_ring = machine::CalibrationRing{{-200, 100}, 0, 20, 50, {}};
  setup.machine.calibration_stud = machine::Boss{{-200, -100}, 30, 30, 40};
  setup.machine.calibration_sphere = machine::CalibrationSphere{{-200, 0, 60}, 12.5};
  return setup;
}

Setup tool_setup() {
  Setup setup;
  machine::ToolSetup& mill = setup.machine.tools.emplace_back(tool_of(5, 100, 6));
  mill.actual_length = 99.97;
  mill.actual_radius = 5.988;
  setup.machine.tt.actual_centre = Vec3{300.4, -0.3, 50.12};
  return setup;
}

Setup kinematics_setup() {
  Setup setup = with_location_errors();
  setup.machine.axes[index(Axis::A)]->min = -60;
  setup.machine.axes[index(Axis::A)]->max = 80;
  setup.machine.axes[index(Axis::C)]->tilt_error_deg = {-0.01, 0.015, 0};
  return setup;
}

/// Values of a block that depend on the frames.
using FrameBlock = std::function<Values(const Frames&)>;

Scenario on_machine(int cycle, const Setup& setup, int tool, const Vec3& tip,
                    const FrameBlock& block, const Read& read) {
  return {cycle, false, [=](const Frames& frames) {
            ProbingBench bench(setup);
            REQUIRE(bench.machine.call_tool({.number = tool, .axis = Axis::Z, .spindle_rpm = {}})
                        .has_value());
            for (const Vec3& target : {Vec3{tip.x, tip.y, 200}, tip}) {
              REQUIRE(bench.machine.move({machine::AxisWords::linear(target), {}}).has_value());
            }
            transform(bench, frames);
            const auto family = cycle == 247 ? CycleFamily::CyclDef : CycleFamily::TchProbe;
            Outcome outcome{
                .error = bench.run(cycle, block(frames), family), .values = {}, .stored = {}};
            INFO(bench.fault.text);
            if (outcome.error == 0) outcome.values = read(bench);
            return outcome;
          }};
}

FrameBlock always(const Values& values) {
  return [values](const Frames&) { return values; };
}
/// A height in the machine as the frames have it.
double height(const Frames& frames, double z) { return frames.from_machine({0, 0, z}).z; }

std::vector<Scenario> scenarios() {
  std::vector<Scenario> all;
  const Vec3 displaced{0.02, -0.03, 0.01};
  for (const NominalCase& c : nominal_cases()) {
    all.push_back({c.cycle, c.only_right_angles,
                   [c, displaced](const Frames& frames) { return run_in(c, frames, displaced); }});
  }
  const Setup probe = calibration_setup();
  all.push_back(on_machine(
      460, probe, 30, {-200.2, 0.3, 80},
      [](const Frames& f) {
        return Values{{407, 12.5}, {433, 1.0}, {434, height(f, 60)}};
      },
      probe_data));
  all.push_back(on_machine(
      461, probe, 30, {-165, 100, 5},
      [](const Frames& f) {
        return Values{{434, height(f, 0)}};
      },
      probe_data));
  all.push_back(
      on_machine(462, probe, 30, {-200.3, 100.2, -12}, always({{407, 25.0}}), probe_data));
  all.push_back(
      on_machine(463, probe, 30, {-199.8, -100.3, 32}, always({{407, 20.0}}), probe_data));
  const Values axes =
      with(with(kinematics_block(), measured(Axis::A, -60, 60, 4)), measured(Axis::C, -90, 180, 4));
  const Setup table = kinematics_setup();
  const Vec3 over = kSphere + Vec3{0, 0, 25};
  all.push_back(
      on_machine(451, table, 30, over, always(with(axes, {{406, 1.0}})), kinematic_results));
  all.push_back(on_machine(452, table, 30, over, always(axes), kinematic_results));
  all.push_back(on_machine(453, table, 30, over, always(values("406=1 407=15 408=90 253=2000")),
                           kinematic_results));
  const FrameBlock check = [](const Frames& f) {
    return Values{{340, 1.0}, {260, height(f, 200)}};
  };
  const Setup mill = tool_setup();
  for (const int cycle : {481, 482, 483}) {
    all.push_back(on_machine(cycle, mill, 5, {0, 0, 200}, check, tool_data));
  }
  const FrameBlock words = [](const Frames& f) {
    return Values{{word(ParameterId::WordCheck), 1.0},
                  {word(ParameterId::WordHeight), height(f, 200)}};
  };
  for (const int cycle : {31, 32, 33}) {
    all.push_back(on_machine(cycle, mill, 5, {0, 0, 200}, words, tool_data));
  }
  all.push_back(on_machine(
      30, mill, 5, {0, 0, 200},
      [](const Frames& f) {
        return Values{{word(ParameterId::WordHeight), height(f, 200)}};
      },
      tool_data));
  all.push_back(on_machine(
      480, mill, 5, {0, 0, 200},
      [](const Frames& f) {
        return Values{{260, height(f, 200)}};
      },
      tool_data));
  all.push_back(on_machine(484, mill, 5, {299, 1, 80}, always({{536, 1.0}}), tool_data));
  Setup lathe = tool_setup();
  machine::ToolSetup& turning = lathe.machine.tools.emplace_back();
  turning.row.number = 6;
  turning.row.lathe = machine::LatheTool{.zl = 100, .xl = -40, .rs = 0.8, .ori = 30};
  turning.actual_xl = -39.98;
  lathe.machine.tt.known.shape = machine::ContactPlate::Cube;
  all.push_back(on_machine(485, lathe, 6, {0, 0, 200}, check, lathe_data));
  all.push_back(on_machine(247, probe, 30, {0, 0, 200}, always({{339, 1.0}}), modal_state));
  all.push_back(
      on_machine(404, probe, 30, {0, 0, 200}, always({{307, 2.5}, {305, 0.0}}), modal_state));
  all.push_back(on_machine(441, probe, 30, {0, 0, 200}, always({{396, 1234.0}}), modal_state));
  all.push_back(on_machine(1493, probe, 30, {0, 0, 200},
                           always({{372, 1.0}, {1145, 3.0}, {1146, 9.0}}), modal_state));
  all.push_back(on_machine(450, table, 30, over, always({{410, 0.0}, {409, 1.0}}), modal_state));
  return all;
}

const FrameRule& rule_of(int cycle) {
  const auto has = [cycle](const FrameRule& rule) {
    return std::ranges::count(rule.cycles, cycle) > 0;
  };
  REQUIRE(std::ranges::count_if(kRules, has) == 1);
  return *std::ranges::find_if(kRules, has);
}

void check_same(const Numbers& a, const Numbers& b, double difference) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CAPTURE(k);
    CHECK(std::abs(a[k] - b[k]) < difference);
  }
}

}  // namespace

TEST_CASE("what frames do is said and tried of every cycle") {
  const std::vector<Scenario> all = scenarios();
  for (const TouchProbeCycle* cycle : cycles()) {
    const int number = cycle->descriptor.number;
    CAPTURE(number);
    CHECK_FALSE(rule_of(number).reason.empty());
    CHECK(std::ranges::count(all, number, &Scenario::cycle) == 1);
  }
}

TEST_CASE("every cycle gives the same results in its own coordinates, or the error of the frame") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.cycle);
    const Outcome plain = scenario.run({});
    CHECK(plain.error == 0);
    for (const NamedFrames& named : kFrames) {
      CAPTURE(named.name);
      const int error = named.error == nullptr ? 0 : rule_of(scenario.cycle).*named.error;
      if (error == 0 && scenario.only_right_angles && !named.right_angles) continue;
      const Outcome outcome = scenario.run(named.frames);
      REQUIRE(outcome.error == error);
      if (error != 0) continue;
      check_same(outcome.values, plain.values, 1e-9);
      check_same(outcome.stored, plain.stored, 1e-6);
    }
  }
}

}  // namespace fitgauge::probing

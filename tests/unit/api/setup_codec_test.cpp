#include "api/runs/setup_codec.hpp"

#include <doctest/doctest.h>

#include "api/runs/run_codec.hpp"
#include "nc/program/program_cache.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

app::ControlTables control_tables() {
  app::ControlTables tables;
  machine::ToolSetup tool;
  tool.row = {.number = 7, .name = "REAMER", .l = 80};
  tables.tools = {tool};
  machine::ProbeSetup probe;
  probe.row.distance = 33;
  tables.probes = {probe};
  tables.presets = {machine::Preset{.number = 5, .comment = {}, .frame = {{1, 2, 3}, {}, {}}}};
  return tables;
}

machine::Setup decode(std::string_view text, const app::ControlTables& tables = {}) {
  FieldErrors errors;
  machine::Setup setup = decode_setup(parse_json(text).value(), "", tables, errors);
  const auto error = errors.take();
  CHECK_MESSAGE(!error, (error ? error->details.front().where : ""));
  return setup;
}

/// "pointer code" of every entry.
std::vector<std::string> complaints(std::string_view text, const app::ControlTables& tables = {}) {
  FieldErrors errors;
  decode_setup(parse_json(text).value(), "", tables, errors);
  std::vector<std::string> found;
  const Error error = errors.take().value();
  for (const Error& detail : error.details) {
    found.push_back(detail.where + " " + std::string(id(detail.code)));
  }
  return found;
}

using Lines = std::vector<std::string>;

TEST_CASE("an empty setup has the defaults of the contract") {
  const machine::Setup setup = decode("{}");
  CHECK(setup.seed == 1);
  CHECK(setup.features.empty());
  CHECK(setup.machine.tools.at(0).row.number == 30);
  CHECK(setup.machine.tools.at(0).row.l == 120);
  CHECK(setup.machine.probes.at(0).row.distance == 20);
  CHECK(setup.machine.active_preset == 1);
}

TEST_CASE("every part of a setup is read") {
  const machine::Setup setup = decode(R"({"machine": {
      "axes": {"X": {"min_mm": -10, "max_mm": 900},
               "A": {"min_deg": -30, "hirth_grid_deg": 3, "on": "head", "center_mm": [1, 2, 3],
                     "scatter_um": 1.5}},
      "start_mm": {"X": 5, "A": 6}, "rapid_mm_min": 9000,
      "tools": [{"number": 4, "name": "MILL", "length_mm": "80.5", "radius_mm": 4,
                 "delta_mm": [0.1, -0.2, 0], "actual_radius_mm": 3.9, "locked": true},
                {"number": 11, "lathe": {"zl_mm": 100, "xl_mm": -40, "dzl_mm": 0.1, "dxl_mm": 0.2,
                 "rs_mm": 0.8, "to": 7, "ori_deg": 90}, "actual_xl_mm": "-40.02"}],
      "probes": [{"number": 2, "set_up_mm": 3, "repeatability_um": 0.4, "center_offset_mm": [0.01, 0]}],
      "tt": {"center_mm": [1, 2, 3], "radius_mm": 15, "shape": "cube"},
      "presets": [{"number": 8, "x_mm": 1.5, "rotation_deg": [0, 0, 2], "locked": true}],
      "active_preset": 8},
    "workpiece": {"features": [
      {"type": "bore", "center_mm": [50, 40], "diameter_mm": 25.013, "lobes": 3,
       "lobe_amplitude_um": 2},
      {"type": "surface", "points_mm": [[0, 0, 1.2], [10, 0, 1.25], [0, 10, 1.1]]}],
      "fixtures": [{"type": "boss", "center_mm": [10, 10], "diameter_mm": 12}]},
    "seed": 99})");
  CHECK(setup.seed == 99);
  const machine::MachineSetup& machine = setup.machine;
  CHECK(machine.tools.at(1).row.lathe ==
        machine::LatheTool{
            .zl = 100, .xl = -40, .dzl = 0.1, .dxl = 0.2, .rs = 0.8, .orientation = 7, .ori = 90});
  CHECK(machine.tools.at(1).actual_xl == -40.02);
  CHECK(machine.tt.known.shape == machine::ContactPlate::Cube);
  CHECK(machine.axes[0]->max == 900);
  REQUIRE(machine.axes[3]);
  CHECK(machine.axes[3]->min == -30);
  CHECK(machine.axes[3]->max == 120);
  CHECK(machine.axes[3]->mount == machine::AxisMount::Head);
  CHECK(machine.axes[3]->scatter_um == 1.5);
  CHECK(machine.start[machine::Axis::A] == 6);
  CHECK(machine.tools.at(0).row.l == 80.5);
  CHECK(machine.tools.at(0).row.dr == -0.2);
  CHECK(machine.tools.at(0).actual_radius == 3.9);
  CHECK(machine.tools.at(0).row.locked);
  CHECK(machine.probes.at(0).repeatability_um == 0.4);
  CHECK(machine.tt.known.radius == 15);
  CHECK(machine.presets.at(0).frame.basic_rotation_deg.z == 2);
  CHECK(machine.active_preset == 8);
  const auto& bore = std::get<machine::Bore>(setup.features.at(0));
  CHECK(bore.diameter == 25.013);
  CHECK(bore.depth == 30);
  CHECK(std::get<machine::Surface>(setup.features.at(1)).points.size() == 3);
  CHECK(std::get<machine::Boss>(setup.fixtures.at(0)).diameter == 12);
}

TEST_CASE("the parameters of the builder for the kinematics are read") {
  const machine::KinematicsOptions given =
      decode(R"({"machine": {"tcpm_option": false, "max_modification_mm": 0.05,
                 "max_calibration_ball_deviation_mm": 0.02, "strobe_rotary_axes": ["A", "C"],
                 "insignificant_corrections": "note"}})")
          .machine.kinematics_options;
  CHECK_FALSE(given.tcpm);
  CHECK(given.max_modification == 0.05);
  CHECK(given.max_ball_deviation == 0.02);
  CHECK(given.strobed == std::array{true, false, true});
  CHECK(given.notes_insignificant);
  CHECK(decode("{}").machine.kinematics_options == machine::KinematicsOptions{});
  CHECK(complaints(R"({"machine": {"strobe_rotary_axes": ["X"], "max_modification_mm": "a",
                      "insignificant_corrections": "ignore"}})")
            .size() == 3);
}

TEST_CASE("tables of the control add rows; rows given go before them") {
  const machine::Setup setup = decode(R"({"machine": {"active_preset": 5}})", control_tables());
  CHECK(setup.machine.tools.size() == 2);
  CHECK(setup.machine.probes.at(0).row.distance == 33);
  CHECK(setup.machine.presets.size() == 2);

  const machine::Setup given = decode(
      R"({"machine": {"tools": [{"number": 7, "length_mm": 81}, {"number": 8}],
                      "probes": [{"number": 1, "dist_mm": 12}]}})",
      control_tables());
  REQUIRE(given.machine.tools.size() == 2);
  CHECK(given.machine.tools[0].row.l == 81);
  CHECK(given.machine.probes.at(0).row.distance == 12);
}

TEST_CASE("what contradicts itself or names nothing is refused with its pointer") {
  CHECK(complaints(R"({"machine": {"active_preset": 5}})") ==
        Lines{"/machine/active_preset field.conflict"});
  CHECK(complaints(R"({"machine": {"tools": [{"number": 1, "radius_mm": 2, "probe": 9}]}})") ==
        Lines{"/machine/tools/0/probe field.conflict"});
  CHECK(complaints(R"({"machine": {"tt": {"radius_mm": 0}}, "seed": -1})") ==
        Lines{"/seed field.invalid", "/machine/tt/radius_mm field.invalid"});
  CHECK(complaints(R"({"workpiece": {"features": [{"type": "bore", "diameter_mm": "a"}]}})") ==
        Lines{"/workpiece/features/0/center_mm field.missing",
              "/workpiece/features/0/diameter_mm length.malformed"});
}

TEST_CASE("an order is read with its setup, by name or in place") {
  const auto find = [](const std::string& name) -> Result<app::NamedDocument> {
    if (name == "mill") return app::NamedDocument{.name = name, .text = R"({"seed": 12})"};
    return Error{ErrorCode::SetupUnknown, "there is no setup '" + name + "'"};
  };
  const auto read = [&](std::string_view text) {
    return decode_run_order(parse_json(text).value(), find, control_tables());
  };
  const auto order = read(R"({"program": "TNC:\\a.h", "setup": "mill", "on_stop": "end",
                              "block_skip": true, "language": "dutch",
                              "limits": {"blocks": 5, "seconds": 0.5},
                              "parameters": {"Q1": 25, "QL3": -1e2, "QS1": "H7"}})")
                         .value();
  CHECK(order.program.text() == "TNC:\\a.h");
  CHECK(order.setup.seed == 12);
  CHECK(order.setup.machine.tools.size() == 2);
  CHECK(order.options.on_stop == interpreter::OnStop::End);
  CHECK(order.options.block_skip);
  CHECK(order.options.language == klartext::MaskLanguage::Dutch);
  CHECK(order.options.limits.blocks == 5);
  CHECK(order.options.limits.time.count() == 0.5);
  CHECK(order.options.parameters.size() == 3);
  // What is kept can be sent again, and says what was meant by the name.
  CHECK(order.request.find(R"("setup":{"seed":12})") != std::string::npos);
  CHECK(read(order.request)->setup.seed == 12);
  CHECK(read(R"({"program": "TNC:\\a.h"})")->setup.seed == 1);

  const auto refused =
      read(R"({"program": "C:\\a.h", "setup": "lathe", "parameters": {"Q1": "H7"}})");
  std::vector<std::string> where;
  for (const Error& detail : refused.error().details) where.push_back(detail.where);
  CHECK(where == Lines{"/setup", "/program", "/parameters/Q1"});
}

}  // namespace

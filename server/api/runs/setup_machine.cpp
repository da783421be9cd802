#include <tuple>

#include "api/runs/setup_reader.hpp"

namespace fitgauge::api {
namespace {

using machine::Axis;

machine::AxisSetup read_axis(SetupReader& reader, Axis axis) {
  machine::AxisSetup setup = machine::AxisSetup::of(axis);
  if (!is_rotary(axis)) {
    reader.mm("min_mm", setup.min);
    reader.mm("max_mm", setup.max);
    return setup;
  }
  reader.number("min_deg", setup.min);
  reader.number("max_deg", setup.max);
  reader.number("hirth_grid_deg", setup.hirth_grid_deg);
  if (const auto mount = reader.fields().optional_text("on")) {
    if (*mount != "table" && *mount != "head") {
      reader.fields().report(ErrorCode::FieldInvalid, "on", "on takes \"table\" or \"head\"");
    }
    setup.mount = *mount == "head" ? machine::AxisMount::Head : machine::AxisMount::Table;
  }
  reader.mm("center_mm", setup.centre);
  reader.numbers("direction", setup.direction);
  reader.mm("center_error_mm", setup.centre_error);
  reader.numbers("tilt_error_deg", setup.tilt_error_deg);
  reader.number("backlash_deg", setup.backlash_deg);
  reader.um("scatter_um", setup.scatter_um);
  return setup;
}

machine::ToolSetup read_tool(SetupReader& reader) {
  machine::ToolSetup tool;
  machine::Tool& row = tool.row;
  if (!reader.fields().has("number")) reader.fields().number("number");  // reports it as missing
  reader.integer("number", row.number, 0, kHighestNumber);
  reader.text("name", row.name);
  reader.mm("length_mm", row.l);
  reader.mm("radius_mm", row.r);
  reader.mm("corner_radius_mm", row.r2);
  std::array<double, 3> delta{};
  reader.mm("delta_mm", delta);
  std::tie(row.dl, row.dr, row.dr2) = std::tie(delta[0], delta[1], delta[2]);
  reader.mm("actual_length_mm", tool.actual_length);
  reader.mm("actual_radius_mm", tool.actual_radius);
  reader.mm("length_tolerance_mm", row.l_tolerance);
  reader.mm("radius_tolerance_mm", row.r_tolerance);
  reader.mm("length_breakage_mm", row.l_breakage);
  reader.mm("radius_breakage_mm", row.r_breakage);
  reader.mm("length_offset_mm", row.l_offset);
  reader.mm("radius_offset_mm", row.r_offset);
  reader.integer("teeth", row.teeth, 0, 1000);
  reader.boolean("locked", row.locked);
  reader.integer("probe", row.probe, 0, kHighestNumber);
  return tool;
}

machine::ProbeSetup read_probe(SetupReader& reader) {
  machine::ProbeSetup probe;
  machine::ProbeRow& row = probe.row;
  reader.integer("number", row.number, 0, kHighestNumber);
  reader.mm("set_up_mm", row.set_up);
  reader.mm("dist_mm", row.distance);
  reader.number("feed_mm_min", row.feed);
  reader.number("fmax_mm_min", row.rapid);
  reader.mm("cal_of1_mm", row.cal_of1);
  reader.mm("cal_of2_mm", row.cal_of2);
  reader.um("repeatability_um", probe.repeatability_um);
  reader.um("pretravel_um", probe.pretravel_um);
  reader.mm("center_offset_mm", probe.centre_offset);
  return probe;
}

machine::Preset read_preset(SetupReader& reader) {
  machine::Preset preset;
  preset.number = 1;
  reader.integer("number", preset.number, 0, kHighestNumber);
  reader.text("comment", preset.comment);
  reader.mm("x_mm", preset.frame.origin.x);
  reader.mm("y_mm", preset.frame.origin.y);
  reader.mm("z_mm", preset.frame.origin.z);
  reader.numbers("rotation_deg", preset.frame.basic_rotation_deg);
  reader.numbers("offsets_deg", preset.frame.rotary_offsets_deg);
  reader.boolean("locked", preset.locked);
  return preset;
}

void read_start(SetupReader& reader, machine::AxisWords& start) {
  for (const Axis axis : machine::kAllAxes) {
    if (!reader.fields().has(name(axis))) continue;
    if (is_rotary(axis)) {
      start[axis] = reader.fields().number(name(axis));
    } else {
      reader.mm(name(axis), start[axis]);
    }
  }
}

void read_tool_touch_probe(SetupReader& reader, machine::ToolTouchProbeSetup& tt) {
  reader.mm("center_mm", tt.known.centre);
  reader.mm("radius_mm", tt.known.radius);
  if (const auto shape = reader.fields().optional_text("shape")) {
    if (*shape != "disc" && *shape != "cube") {
      reader.fields().report(ErrorCode::FieldInvalid, "shape", "shape takes \"disc\" or \"cube\"");
    }
    tt.shape = *shape == "cube" ? machine::ContactPlate::Cube : machine::ContactPlate::Disc;
  }
  if (reader.fields().has("actual_center_mm")) {
    reader.mm("actual_center_mm", tt.actual_centre.emplace(tt.known.centre));
  }
  reader.mm("actual_radius_mm", tt.actual_radius);
  reader.um("repeatability_um", tt.repeatability_um);
}

void read_calibration_ring(SetupReader& reader, machine::CalibrationRing& ring) {
  read_cylinder(reader, ring);
  reader.mm("outer_diameter_mm", ring.outer_diameter);
}

}  // namespace

machine::MachineSetup read_machine(SetupReader& reader) {
  machine::MachineSetup machine;
  reader.object("axes", [&machine](SetupReader& axes) {
    for (const Axis axis : machine::kAllAxes) {
      axes.object(name(axis), [&](SetupReader& fields) {
        machine.axes[index(axis)] = read_axis(fields, axis);
      });
    }
  });
  reader.object("start_mm", [&machine](SetupReader& start) { read_start(start, machine.start); });
  reader.number("rapid_mm_min", machine.rapid_mm_min);
  reader.array("tools", machine.tools, read_tool);
  reader.array("probes", machine.probes, read_probe);
  reader.object("tt", [&machine](SetupReader& tt) { read_tool_touch_probe(tt, machine.tt); });
  reader.object("calibration_ring", [&machine](SetupReader& ring) {
    read_calibration_ring(ring, machine.calibration_ring.emplace());
  });
  reader.object("calibration_stud", [&machine](SetupReader& stud) {
    machine.calibration_stud = machine::Boss{.height = 20};
    read_cylinder(stud, *machine.calibration_stud);
  });
  reader.object("calibration_sphere", [&machine](SetupReader& fields) {
    machine::CalibrationSphere& sphere = machine.calibration_sphere.emplace();
    fields.required_mm("center_mm", sphere.centre);
    fields.mm("radius_mm", sphere.radius);
  });
  reader.array("presets", machine.presets, read_preset);
  reader.integer("active_preset", machine.active_preset, 0, kHighestNumber);
  return machine;
}

}  // namespace fitgauge::api

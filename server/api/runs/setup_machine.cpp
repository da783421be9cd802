#include <tuple>

#include "api/runs/setup_fields.hpp"

namespace fitgauge::api {
namespace {

using machine::Axis;

void read_rotary_axis(SetupFields& fields, machine::AxisSetup& setup) {
  fields.number({"min_deg", "Lower end of its range"}, setup.min);
  fields.number({"max_deg", "Upper end of its range"}, setup.max);
  fields.number({"hirth_grid_deg", "Step of a Hirth coupling; 0: any angle"}, setup.hirth_grid_deg);
  constexpr std::array<std::string_view, 2> kMounts{"table", "head"};
  std::size_t mount = setup.mount == machine::AxisMount::Head ? 1 : 0;
  fields.word({"on", "What it turns: the table or the head"}, kMounts, mount);
  setup.mount = mount == 1 ? machine::AxisMount::Head : machine::AxisMount::Table;
  fields.mm({"center_mm", "A point of its axis as the control models it; of a table"},
            setup.centre);
  fields.numbers({"direction", "Of its axis, any length: the tool turns around it"},
                 setup.direction);
  fields.mm({"center_error_mm", "Real centre minus modelled centre"}, setup.centre_error);
  fields.numbers({"tilt_error_deg", "Spatial angles by which the real axis is tilted"},
                 setup.tilt_error_deg);
  fields.number({"zero_error_deg", "By how much it is turned where it shows 0"},
                setup.zero_error_deg);
  fields.number({"backlash_deg", "Lost motion when the direction of turning changes"},
                setup.backlash_deg);
  fields.um({"scatter_um", "Standard deviation of where it comes to rest"}, setup.scatter_um);
}

void read_axis(SetupFields& fields, Axis axis, machine::AxisSetup& setup) {
  if (is_rotary(axis)) return read_rotary_axis(fields, setup);
  fields.mm({"min_mm", "Lower end of the spindle nose's range"}, setup.min);
  fields.mm({"max_mm", "Upper end of the spindle nose's range"}, setup.max);
}

machine::ToolSetup read_tool(SetupFields& fields) {
  machine::ToolSetup tool;
  machine::Tool& row = tool.row;
  fields.required_integer({"number", "T of the tool table"}, row.number, 0, kHighestNumber);
  fields.text({"name", "NAME"}, row.name);
  fields.mm({"length_mm", "L"}, row.l);
  fields.mm({"radius_mm", "R"}, row.r);
  fields.mm({"corner_radius_mm", "R2"}, row.r2);
  std::array<double, 3> delta{};
  fields.mm({"delta_mm", "DL, DR and DR2: wear"}, delta);
  std::tie(row.dl, row.dr, row.dr2) = std::tie(delta[0], delta[1], delta[2]);
  fields.mm({"actual_length_mm", "What the real tool has; L + DL when absent"}, tool.actual_length);
  fields.mm({"actual_radius_mm", "What the real tool has; R + DR when absent"}, tool.actual_radius);
  fields.mm({"length_tolerance_mm", "LTOL: wear beyond it locks the tool"}, row.l_tolerance);
  fields.mm({"radius_tolerance_mm", "RTOL: wear beyond it locks the tool"}, row.r_tolerance);
  fields.mm({"length_breakage_mm", "LBREAK: a difference beyond it is breakage"}, row.l_breakage);
  fields.mm({"radius_breakage_mm", "RBREAK: a difference beyond it is breakage"}, row.r_breakage);
  fields.mm({"length_offset_mm", "L-OFFS of the tool touch probe"}, row.l_offset);
  fields.mm({"radius_offset_mm", "R-OFFS of the tool touch probe"}, row.r_offset);
  fields.integer({"teeth", "CUT: number of teeth"}, row.teeth, 0, 1000);
  fields.boolean({"locked", "TL: the tool is locked"}, row.locked);
  fields.integer({"probe", "TP_NO: its row of the touch-probe table; 0: no touch probe"}, row.probe,
                 0, kHighestNumber);
  return tool;
}

machine::ProbeSetup read_probe(SetupFields& fields) {
  machine::ProbeSetup probe;
  machine::ProbeRow& row = probe.row;
  fields.integer({"number", "NO of the touch-probe table"}, row.number, 0, kHighestNumber);
  fields.mm({"set_up_mm", "SET_UP: clearance before the point to touch"}, row.set_up);
  fields.mm({"dist_mm", "DIST: longest probing path"}, row.distance);
  fields.number({"feed_mm_min", "F: probing feed"}, row.feed);
  fields.number({"fmax_mm_min", "FMAX: feed for positioning"}, row.rapid);
  fields.mm({"cal_of1_mm", "CAL_OF1: calibrated offset in the main axis"}, row.cal_of1);
  fields.mm({"cal_of2_mm", "CAL_OF2: calibrated offset in the secondary axis"}, row.cal_of2);
  fields.um({"repeatability_um", "Standard deviation of a contact along the probing direction"},
            probe.repeatability_um);
  fields.um({"pretravel_um", "Travel from touching to the trigger"}, probe.pretravel_um);
  fields.mm({"center_offset_mm", "Spindle axis to the real ball centre, at 0 degrees"},
            probe.centre_offset);
  return probe;
}

machine::Preset read_preset(SetupFields& fields) {
  machine::Preset preset;
  preset.number = 1;
  fields.integer({"number", "NO of the preset table"}, preset.number, 0, kHighestNumber);
  fields.text({"comment", "DOC"}, preset.comment);
  fields.mm({"x_mm", "X of the workpiece zero on the machine"}, preset.frame.origin.x);
  fields.mm({"y_mm", "Y of it"}, preset.frame.origin.y);
  fields.mm({"z_mm", "Z of it"}, preset.frame.origin.z);
  fields.numbers({"rotation_deg", "SPA, SPB, SPC: basic rotation"},
                 preset.frame.basic_rotation_deg);
  fields.numbers({"offsets_deg", "A_OFFS, B_OFFS, C_OFFS: of the rotary axes"},
                 preset.frame.rotary_offsets_deg);
  fields.boolean({"locked", "The row is write-protected"}, preset.locked);
  return preset;
}

void read_start(SetupFields& fields, machine::AxisWords& start) {
  for (const Axis axis : machine::kAllAxes) {
    if (is_rotary(axis)) {
      fields.number({name(axis), "In degrees; 0 when absent"}, start[axis]);
    } else {
      fields.mm({name(axis), "0 when absent, the tool axis at its maximum"}, start[axis]);
    }
  }
}

void read_tool_touch_probe(SetupFields& fields, machine::ToolTouchProbeSetup& tt) {
  fields.mm({"center_mm", "Centre of the contact plate's top as the control knows it"},
            tt.known.centre);
  fields.mm({"radius_mm", "Of the disc, or half the side of the cube"}, tt.known.radius);
  constexpr std::array<std::string_view, 2> kShapes{"disc", "cube"};
  std::size_t shape = tt.shape == machine::ContactPlate::Cube ? 1 : 0;
  fields.word({"shape", "Of the contact plate; a cube lies along X and Y"}, kShapes, shape);
  tt.shape = shape == 1 ? machine::ContactPlate::Cube : machine::ContactPlate::Disc;
  fields.mm({"actual_center_mm", "Where it really is; as known when absent"}, tt.actual_centre);
  fields.mm({"actual_radius_mm", "What it really has; as known when absent"}, tt.actual_radius);
  fields.um({"repeatability_um", "Standard deviation of a contact along the probing direction"},
            tt.repeatability_um);
}

void read_calibration_standards(SetupFields& fields, machine::MachineSetup& machine) {
  fields.object({"calibration_ring", "A ring gauge, for cycle 462"}, "CalibrationRing",
                [&machine](SetupFields& members) {
                  machine::CalibrationRing& ring = machine.calibration_ring.emplace();
                  read_cylinder(members, ring);
                  members.mm({"outer_diameter_mm", "40 mm more than the hole when absent"},
                             ring.outer_diameter);
                });
  fields.object({"calibration_stud", "A calibration pin, for cycle 463"}, "CalibrationStud",
                [&machine](SetupFields& members) {
                  machine::Boss& stud = machine.calibration_stud.emplace();
                  stud.height = 20;
                  read_cylinder(members, stud);
                });
  fields.object(
      {"calibration_sphere", "A calibration sphere, for cycles 451 to 453 and 460"},
      "CalibrationSphere", [&machine](SetupFields& members) {
        machine::CalibrationSphere& sphere = machine.calibration_sphere.emplace();
        members.required_mm({"center_mm", "Its centre, fixed to the table"}, sphere.centre);
        members.mm({"radius_mm", "Its radius"}, sphere.radius);
      });
}

/// What the builder's parameters say about cycles 451 to 453.
void read_kinematics_options(SetupFields& fields, machine::KinematicsOptions& options) {
  fields.boolean({"tcpm_option", "M128 and FUNCTION TCPM are available"}, options.tcpm);
  constexpr std::array<std::string_view, 3> kLetters{"A", "B", "C"};
  fields.words({"strobe_rotary_axes", "mStrobeRotAxPos: axes that an M function positions"},
               kLetters, options.strobed);
  fields.mm({"max_modification_mm", "maxModification: a larger correction waits for NC Start"},
            options.max_modification);
  fields.mm({"max_calibration_ball_deviation_mm", "maxDevCalBall: of the sphere's radius"},
            options.max_ball_deviation);
  constexpr std::array<std::string_view, 2> kReactions{"refuse", "note"};
  std::size_t reaction = options.notes_insignificant ? 1 : 0;
  fields.word({"insignificant_corrections",
               "What becomes of a correction below twice its uncertainty: left out, with 1102 when "
               "none is left, or made with a note"},
              kReactions, reaction);
  options.notes_insignificant = reaction == 1;
}

}  // namespace

void read_machine(SetupFields& fields, machine::MachineSetup& machine) {
  fields.object({"axes", "X, Y and Z are always there, A, B and C where they are named"}, "Axes",
                [&machine](SetupFields& axes) {
                  for (const Axis axis : machine::kAllAxes) {
                    const bool rotary = is_rotary(axis);
                    axes.object({name(axis), ""}, rotary ? "RotaryAxis" : "LinearAxis",
                                [&machine, axis](SetupFields& members) {
                                  machine::AxisSetup setup = machine::AxisSetup::of(axis);
                                  read_axis(members, axis, setup);
                                  machine.axes[index(axis)] = setup;
                                });
                  }
                });
  fields.object({"start_mm", "Where the spindle nose starts"}, "StartPosition",
                [&machine](SetupFields& start) { read_start(start, machine.start); });
  fields.number({"rapid_mm_min", "Rapid traverse"}, machine.rapid_mm_min);
  read_kinematics_options(fields, machine.kinematics_options);
  fields.array({"tools", "Rows of the tool table; number 30, a touch probe, when absent"}, "Tool",
               machine.tools, read_tool);
  fields.array({"probes", "Rows of the touch-probe table; number 1 when absent"}, "Probe",
               machine.probes, read_probe);
  fields.object({"tt", "The tool touch probe"}, "ToolTouchProbe",
                [&machine](SetupFields& tt) { read_tool_touch_probe(tt, machine.tt); });
  read_calibration_standards(fields, machine);
  fields.array({"presets", "Rows of the preset table; number 1, all zero, when absent"}, "Preset",
               machine.presets, read_preset);
  fields.integer({"active_preset", "The row that is active at the start"}, machine.active_preset, 0,
                 kHighestNumber);
}

}  // namespace fitgauge::api

#pragma once

#include "api/runs/setup_codec.hpp"

// The members of a setup's machine.

namespace fitgauge::api {

constexpr int kHighestNumber = 65535;  ///< of a tool, a probe or a preset

void rotary_axis_members(auto& v, machine::AxisSetup& setup) {
  v.optional("min_deg", setup.min, Number{}, "Lower end of its range");
  v.optional("max_deg", setup.max, Number{}, "Upper end of its range");
  v.optional("hirth_grid_deg", setup.hirth_grid_deg, Number{},
             "Step of a Hirth coupling; 0: any angle");
  v.optional("on", setup.mount, OneOf<2>{"table", "head"}, "Place of the axis: table or head");
  v.optional("center_mm", setup.centre, Mm3{},
             "A point of its axis as the control models it; of a table");
  v.optional("direction", setup.direction, Numbers3{},
             "Direction of the axis that the tool turns around; any length");
  v.optional("center_error_mm", setup.centre_error, Mm3{}, "Real centre minus modelled centre");
  v.optional("tilt_error_deg", setup.tilt_error_deg, Numbers3{},
             "Spatial angles by which the real axis is tilted");
  v.optional("zero_error_deg", setup.zero_error_deg, Number{},
             "Real angle at the indicated angle 0");
  v.optional("backlash_deg", setup.backlash_deg, Number{},
             "Lost motion when the direction of turning changes");
  v.optional("scatter_um", setup.scatter_um, Um{},
             "Standard deviation of the position where it comes to rest");
}

void linear_axis_members(auto& v, machine::AxisSetup& setup) {
  v.optional("min_mm", setup.min, Mm{}, "Lower end of the spindle nose's range");
  v.optional("max_mm", setup.max, Mm{}, "Upper end of the spindle nose's range");
}

void members(auto& v, machine::LatheTool& lathe) {
  v.member("zl_mm", lathe.zl, Mm{}, "ZL: spindle nose to the tip, along the tool");
  v.member("xl_mm", lathe.xl, Mm{}, "XL: spindle axis to the tip, along X at ORI");
  v.optional("dzl_mm", lathe.dzl, Mm{}, "DZL: wear of ZL");
  v.optional("dxl_mm", lathe.dxl, Mm{}, "DXL: wear of XL");
  v.optional("rs_mm", lathe.rs, Mm{}, "RS: radius of the cutting edge");
  v.optional("to", lathe.orientation, Integer{0, 9}, "TO: where the tip points");
  v.optional("ori_deg", lathe.ori, Number{}, "ORI: angle of the spindle");
}

void members(auto& v, machine::ToolSetup& tool) {
  machine::Tool& row = tool.row;
  v.member("number", row.number, Integer{1, kHighestNumber}, "T of the tool table");
  v.optional("name", row.name, "NAME");
  v.optional("length_mm", row.l, Mm{}, "L");
  v.optional("radius_mm", row.r, Mm{}, "R");
  v.optional("corner_radius_mm", row.r2, Mm{}, "R2");
  std::array<double, 3> delta{};
  v.optional("delta_mm", delta, Mm3{}, "DL, DR and DR2: wear");
  std::tie(row.dl, row.dr, row.dr2) = std::tie(delta[0], delta[1], delta[2]);
  v.optional("actual_length_mm", tool.actual_length, Mm{},
             "Real length of the tool, ZL of a lathe tool (default: L + DL)");
  v.optional("actual_radius_mm", tool.actual_radius, Mm{},
             "Real radius of the tool (default: R + DR)");
  v.optional("length_tolerance_mm", row.l_tolerance, Mm{}, "LTOL: wear beyond it locks the tool");
  v.optional("radius_tolerance_mm", row.r_tolerance, Mm{}, "RTOL: wear beyond it locks the tool");
  v.optional("length_breakage_mm", row.l_breakage, Mm{},
             "LBREAK: a difference beyond it is breakage");
  v.optional("radius_breakage_mm", row.r_breakage, Mm{},
             "RBREAK: a difference beyond it is breakage");
  v.optional("length_offset_mm", row.l_offset, Mm{}, "L-OFFS of the tool touch probe");
  v.optional("radius_offset_mm", row.r_offset, Mm{}, "R-OFFS of the tool touch probe");
  v.optional("teeth", row.teeth, Integer{0, 1000}, "CUT: number of teeth");
  v.optional("locked", row.locked, "TL: the tool is locked");
  v.optional("probe", row.probe, Integer{0, kHighestNumber},
             "TP_NO: its row of the touch-probe table; 0: no touch probe");
  v.optional("lathe", row.lathe, Object<machine::LatheTool>{"LatheTool"},
             "A lathe tool: its row of the turning-tool table");
  v.optional("actual_xl_mm", tool.actual_xl, Mm{}, "Real XL of a lathe tool (default: XL + DXL)");
}

void members(auto& v, machine::ProbeSetup& probe) {
  machine::ProbeRow& row = probe.row;
  v.optional("number", row.number, Integer{1, kHighestNumber}, "NO of the touch-probe table");
  v.optional("set_up_mm", row.set_up, Mm{}, "SET_UP: clearance before the point to touch");
  v.optional("dist_mm", row.distance, Mm{}, "DIST: longest probing path");
  v.optional("feed_mm_min", row.feed, Number{}, "F: probing feed");
  v.optional("fmax_mm_min", row.rapid, Number{}, "FMAX: feed for positioning");
  v.optional("cal_of1_mm", row.cal_of1, Mm{}, "CAL_OF1: calibrated offset in the main axis");
  v.optional("cal_of2_mm", row.cal_of2, Mm{}, "CAL_OF2: calibrated offset in the secondary axis");
  v.optional("uncertainty_um", row.uncertainty_um, Um{},
             "Standard uncertainty of a touch; with it diameters are judged with a guard band");
  v.optional("repeatability_um", probe.repeatability_um, Um{},
             "Standard deviation of a contact along the probing direction");
  v.optional("pretravel_um", probe.pretravel_um, Um{}, "Travel from touching to the trigger");
  v.optional("center_offset_mm", probe.centre_offset, Mm2{},
             "Spindle axis to the real ball centre, at 0 degrees");
}

void members(auto& v, machine::Preset& preset) {
  v.optional("number", preset.number, Integer{0, kHighestNumber}, "NO of the preset table");
  v.optional("comment", preset.comment, "DOC");
  v.optional("x_mm", preset.frame.origin.x, Mm{}, "X of the workpiece zero on the machine");
  v.optional("y_mm", preset.frame.origin.y, Mm{}, "Y of the workpiece zero on the machine");
  v.optional("z_mm", preset.frame.origin.z, Mm{}, "Z of the workpiece zero on the machine");
  v.optional("rotation_deg", preset.frame.basic_rotation_deg, Numbers3{},
             "SPA, SPB, SPC: basic rotation");
  v.optional("offsets_deg", preset.frame.rotary_offsets_deg, Numbers3{},
             "A_OFFS, B_OFFS, C_OFFS: of the rotary axes");
  v.optional("locked", preset.locked, "The row is write-protected");
}

void members(auto& v, machine::AxisWords& start) {
  for (const machine::Axis axis : machine::kAllAxes) {
    if (is_rotary(axis)) {
      v.optional(name(axis), start[axis], Number{}, "Angle in degrees (default: 0)");
    } else {
      v.optional(name(axis), start[axis], Mm{},
                 "Position in mm (default: 0, the tool axis at its maximum)");
    }
  }
}

void members(auto& v, machine::ToolTouchProbeSetup& tt) {
  v.optional("center_mm", tt.known.centre, Mm3{},
             "Centre of the contact plate's top as the control knows it");
  v.optional("radius_mm", tt.known.radius, Mm{},
             "Radius of the disc, or half the side of the cube");
  v.optional("shape", tt.known.shape, OneOf<2>{"disc", "cube"},
             "Shape of the contact plate; a cube lies along X and Y");
  v.optional("actual_center_mm", tt.actual_centre, Mm3{}, "Real centre (default: the known one)");
  v.optional("actual_radius_mm", tt.actual_radius, Mm{}, "Real radius (default: the known one)");
  v.optional("repeatability_um", tt.repeatability_um, Um{},
             "Standard deviation of a contact along the probing direction");
}

/// The members that a boss, a calibration stud and a calibration ring have in common.
void cylinder_members(auto& v, auto& cylinder) {
  v.member("center_mm", cylinder.centre, Mm2{}, "X and Y of its axis");
  v.optional("top_mm", cylinder.top, Mm{}, "Z of the upper end");
  v.optional("height_mm", cylinder.height, Mm{}, "Height from the upper end down");
  v.member("diameter_mm", cylinder.diameter, Mm{}, "Diameter");
}

void members(auto& v, machine::Boss& boss) { cylinder_members(v, boss); }

void members(auto& v, machine::CalibrationRing& ring) {
  cylinder_members(v, ring);
  v.optional("outer_diameter_mm", ring.outer_diameter, Mm{},
             "Outer diameter (default: 40 mm more than the hole)");
}

void members(auto& v, machine::CalibrationSphere& sphere) {
  v.member("center_mm", sphere.centre, Mm3{}, "Centre of the sphere, fixed to the table");
  v.optional("radius_mm", sphere.radius, Mm{}, "Radius");
}

/// The machine builder's parameters of cycles 451 to 453.
void kinematics_members(auto& v, machine::KinematicsOptions& options) {
  v.optional("tcpm_option", options.tcpm, "M128 and FUNCTION TCPM are available");
  v.optional("strobe_rotary_axes", options.strobed, SomeOf<3>{"A", "B", "C"},
             "mStrobeRotAxPos: axes that an M function positions");
  v.optional("max_modification_mm", options.max_modification, Mm{},
             "maxModification: a larger correction waits for NC Start");
  v.optional("max_calibration_ball_deviation_mm", options.max_ball_deviation, Mm{},
             "maxDevCalBall: largest deviation of the sphere's radius");
  v.optional("insignificant_corrections", options.notes_insignificant, OneOf<2>{"refuse", "note"},
             "Corrections below twice their uncertainty: left out, with 1102 if none remains, or "
             "made with a note");
}

/// The form of an axis, whose members and defaults depend on which it is.
inline constexpr auto axis_form(machine::Axis axis) {
  return Nested{is_rotary(axis) ? "RotaryAxis" : "LinearAxis",
                [axis](auto& v, machine::AxisSetup& setup) {
                  setup = machine::AxisSetup::of(axis);
                  is_rotary(axis) ? rotary_axis_members(v, setup) : linear_axis_members(v, setup);
                }};
}
inline constexpr Nested kAxesForm{"Axes", [](auto& v, auto& axes) {
                                    for (const machine::Axis axis : machine::kAllAxes)
                                      v.optional(name(axis), axes[index(axis)], axis_form(axis));
                                  }};
inline constexpr Nested kStudForm{"CalibrationStud", [](auto& v, machine::Boss& stud) {
                                    stud.height = 20;
                                    members(v, stud);
                                  }};
inline constexpr Nested kPresetForm{"Preset", [](auto& v, machine::Preset& preset) {
                                      preset = machine::MachineSetup::default_preset();
                                      members(v, preset);
                                    }};

void members(auto& v, machine::MachineSetup& machine) {
  v.optional("axes", machine.axes, kAxesForm,
             "X, Y and Z are always given; A, B and C if they are named");
  v.optional("start_mm", machine.start, Object<machine::AxisWords>{"StartPosition"},
             "Start position of the spindle nose");
  v.optional("rapid_mm_min", machine.rapid_mm_min, Number{}, "Rapid traverse");
  kinematics_members(v, machine.kinematics_options);
  v.optional("tools", machine.tools, List<machine::ToolSetup>{{"Tool"}},
             "Rows of the tool table (default: number 30, a touch probe)");
  v.optional("probes", machine.probes, List<machine::ProbeSetup>{{"Probe"}},
             "Rows of the touch-probe table (default: number 1)");
  v.optional("tt", machine.tt, Object<machine::ToolTouchProbeSetup>{"ToolTouchProbe"},
             "The tool touch probe");
  v.optional("calibration_ring", machine.calibration_ring,
             Object<machine::CalibrationRing>{"CalibrationRing"}, "A ring gauge, for cycle 462");
  v.optional("calibration_stud", machine.calibration_stud, kStudForm,
             "A calibration pin, for cycle 463");
  v.optional("calibration_sphere", machine.calibration_sphere,
             Object<machine::CalibrationSphere>{"CalibrationSphere"},
             "A calibration sphere, for cycles 451 to 453 and 460");
  v.optional("presets", machine.presets, List<machine::Preset, decltype(kPresetForm)>{kPresetForm},
             "Rows of the preset table (default: number 1, all zero)");
  v.optional("active_preset", machine.active_preset, Integer{0, kHighestNumber},
             "The row that is active at the start");
  builder_members(v);
}

}  // namespace fitgauge::api

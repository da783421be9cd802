#pragma once

#include "nc/machine/machine.hpp"
#include "nc/run/active_cycle.hpp"
#include "nc/run/cutter_path.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/plane_geometry.hpp"
#include "nc/run/run_budget.hpp"

/// The machining cycles as motion of the tool, one function for each shape. Each begins at the
/// current position in the plane and ends over the surface, at the larger of its clearances.
/// @errors 1010 no feed, 1042 a depth of 0, and those of the machine and the budget.
namespace fitgauge::interpreter {

/// The moves of a machining cycle: in the working plane, and at heights along the tool axis, in mm
/// of the input system. Each checks the run's budget first; a move to the current position is
/// skipped.
class ToolMotion {
 public:
  /// Both must outlive this object. The plane is that of the current tool.
  ToolMotion(machine::Machine& machine, RunBudget& budget);

  NcResult<void> to_height(double height, const machine::Feed& feed);
  NcResult<void> to_point(Vec2 point, const machine::Feed& feed);
  /// Moves around `centre` to `end` and `height`; a sweep beyond 360 degrees is a helix.
  NcResult<void> arc(Vec2 centre, Vec2 end, double sweep_deg, double height,
                     const machine::Feed& feed);
  /// Waits; does nothing for 0.
  NcResult<void> dwell(double seconds);
  NcResult<void> set_modes(const machine::Modes& modes);

  Vec2 point() const;
  double height() const;
  const WorkingPlane& plane() const { return plane_; }
  const machine::MachineState& state() const { return machine_.state(); }
  /// Returns the radius in the plane; scaling does not scale the tool.
  double tool_radius() const { return radius_in_plane(state(), state().tool_radius()); }

 private:
  machine::Machine& machine_;
  RunBudget& budget_;
  const WorkingPlane plane_;
};

class Channel;

/// The heights of a cycle along the tool axis.
struct Heights {
  double surface = 0;    ///< Q203, of 232 Q227
  double clearance = 0;  ///< Q200 above it
  double second = 0;     ///< Q204 above it, or the clearance if it is higher
  double bottom = 0;     ///< Q201 below it, of 232 Q386
};

/// The input of one execution of a cycle.
struct Machining {
  const MachiningDefinition& definition;
  ToolMotion motion;
  Heights heights;

  Machining(const ToolMotion& tool, const MachiningDefinition& defined);
  double value(int parameter) const { return definition.value(parameter); }
  machine::Feed feed(int parameter) const;
  /// Q208; for 0 the feed of plunging (decision 30); rapid without it.
  machine::Feed retraction() const;
  NcResult<void> start();
  NcResult<void> leave();
};

machine::Feed feed_of(double rate);

// drilling.cpp
/// Stop distance of 1 and 21 above the drilled depth: a fiftieth of the hole, from 0.6 to 7 mm.
double advanced_stop(double depth);
NcResult<void> drill(Machining& cycle);
NcResult<void> tap(Machining& cycle);
NcResult<void> bore(Machining& cycle);
NcResult<void> bore_back(Machining& cycle);

// milling.cpp
NcResult<void> mill_bore(Machining& cycle);
NcResult<void> mill_rectangle(Machining& cycle);
NcResult<void> mill_circle(Machining& cycle);
NcResult<void> mill_slot(Machining& cycle);
NcResult<void> mill_circular_slot(Machining& cycle);
NcResult<void> mill_thread(Machining& cycle);
NcResult<void> mill_rectangular_stud(Machining& cycle);
NcResult<void> mill_circular_stud(Machining& cycle);
NcResult<void> engrave(Machining& cycle);

// face_milling.cpp
/// 232. @errors 1002 the tool has no radius.
NcResult<void> mill_face(Machining& cycle);

// contour_pocket.cpp
/// 21 to 24. @errors 1017 without cycles 14 and 20.
NcResult<void> mill_contours(Channel& channel, Machining& cycle);

// patterns.cpp
/// 220 and 221: runs the cycle before it at each point.
NcResult<void> run_pattern(Channel& channel, const MachiningDefinition& pattern);
/// CYCL CALL PAT.
NcResult<void> run_points(Channel& channel);

/// @errors those of contradiction().
NcResult<void> check_values(const MachiningDefinition& definition);

/// The cycle that M99 runs at the position of the tool. @errors those of check_values(), 1108.
NcResult<void> machine_here(Channel& channel, const MachiningDefinition& definition);

}  // namespace fitgauge::interpreter

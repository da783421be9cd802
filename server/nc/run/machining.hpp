#pragma once

#include "nc/program/cycles.hpp"
#include "nc/run/cutter_path.hpp"

/// The machining cycles as motion of the tool, one function for each shape. Each begins at the
/// current position in the plane and ends over the surface, at the larger of its clearances.
/// @errors 1010 no feed, 1042 a depth of 0, and those of the machine and the budget.
namespace fitgauge::interpreter {

/// A machining cycle with the values of its block, defaults included, in mm, mm/min, degrees and
/// seconds, by the number of their parameter. A feed of infinity is FMAX.
struct MachiningDefinition {
  const MachiningCycle* cycle = nullptr;
  std::map<int, double> values{};
  std::set<int> given{};  ///< the parameters that the block names
  std::string text{};     ///< QS500

  double value(int parameter, double otherwise = 0) const {
    const auto it = values.find(parameter);
    return it == values.end() ? otherwise : it->second;
  }
  bool gives(int parameter) const { return given.contains(parameter); }
};

/// A cycle of the machine builder that the setup ignores.
struct IgnoredCycle {};

/// The target of CYCL CALL, M99 and M89: the last call-active cycle, a machining cycle or a program
/// (CYCL DEF 12); and what cycles and PATTERN DEF leave for it.
struct ActiveCycle {
  std::variant<std::monostate, MachiningDefinition, ControlPath, IgnoredCycle> definition;
  bool after_every_block = false;  ///< M89
  /// Numbers for FN 18 ID 10: the last call-active cycle and the last TCH PROBE.
  int number = -1;
  int last_probing = -1;
  std::vector<Vec3> pattern{};                        ///< PATTERN DEF: X, Y, and in Z its surface
  std::vector<std::uint32_t> contours{};              ///< labels of cycle 14
  std::optional<MachiningDefinition> contour_data{};  ///< cycle 20
};

/// The moves of a machining cycle: in the working plane, and at heights along the tool axis, in mm
/// of the input system. Each checks the run's budget first; a move to the current position is
/// skipped.
class ToolMotion {
 public:
  /// Both must outlive this object. The plane is that of the current tool.
  ToolMotion(Machine& machine, RunBudget& budget);

  NcResult<void> to_height(double height, const Feed& feed);
  NcResult<void> to_point(Vec2 point, const Feed& feed);
  /// Moves around `centre` to `end` and `height`; a sweep beyond 360 degrees is a helix.
  NcResult<void> arc(Vec2 centre, Vec2 end, double sweep_deg, double height, const Feed& feed);
  /// Waits; does nothing for 0.
  NcResult<void> dwell(double seconds);
  NcResult<void> set_modes(const Modes& modes);

  Vec2 point() const;
  double height() const;
  const WorkingPlane& plane() const { return plane_; }
  const MachineState& state() const { return machine_.state(); }
  /// Returns the radius in the plane; scaling does not scale the tool.
  double tool_radius() const { return radius_in_plane(state(), state().tool_radius()); }

 private:
  Machine& machine_;
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
struct Machining : ToolMotion {
  const MachiningDefinition& definition;
  Heights heights;

  Machining(const ToolMotion& tool, const MachiningDefinition& defined);
  double value(int parameter) const { return definition.value(parameter); }
  Feed feed(int parameter) const;
  /// Q208; for 0 the feed of plunging (decision 30); rapid without it.
  Feed retraction() const;
  NcResult<void> start();
  NcResult<void> leave();
};

Feed feed_of(double rate);

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

// machining.cpp
/// 232, by page 236 of the TNC 640 manual 34059x-01; that Q389 = 1 steps over at the feed for
/// milling is of page 298 of the TNC 320 manual 340 551-02. @errors 1002 the tool has no radius.
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

// machining_arguments.cpp

/// The values of a cycle in Q parameters, without its defaults. @errors decision 3.
NcResult<Arguments> cycle_arguments(Channel& channel, const klartext::Cycle& cycle,
                                    const BoundCycle& bound);

/// The values of a machining cycle in Q parameters. @errors 1004, 1011 a value out of its range.
NcResult<MachiningDefinition> machining_arguments(Channel& channel, const klartext::Cycle& cycle,
                                                  const BoundCycle& bound);

/// A word of a cycle in sub-lines.
struct PartWord {
  int part;
  Word word;
};
/// All words of a cycle in sub-lines, from block `first` to `last`.
std::vector<PartWord> words_of_parts(const Channel& channel, std::uint32_t first,
                                     std::uint32_t last);

/// The values of an old cycle in sub-lines, from block `first` to `last`.
NcResult<MachiningDefinition> machining_arguments(Channel& channel, const MachiningCycle& cycle,
                                                  std::uint32_t first, std::uint32_t last);

/// The words of a touch-probe cycle in sub-lines (0, 1, 3, 4) as its arguments.
NcResult<Arguments> dotted_arguments(Channel& channel, const TouchProbeCycle& cycle,
                                     std::uint32_t first, std::uint32_t last);

/// The labels of cycle 14.
NcResult<std::vector<std::uint32_t>> contour_labels(Channel& channel, std::uint32_t first,
                                                    std::uint32_t last);

}  // namespace fitgauge::interpreter

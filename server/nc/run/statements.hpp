#pragma once

#include "nc/run/values.hpp"

/// One function for each kind of block; a family is in one exec_* file.
namespace fitgauge::interpreter {

/// The next step of the run after a block.
struct Next {
  enum class Kind : std::uint8_t { Block, Jump, CallLabel, CallProgram, EndRun };
  Kind kind = Kind::Block;
  std::uint32_t target = 0;  ///< of Jump and CallLabel: an instruction
  std::shared_ptr<const LinkedProgram> program = nullptr;  ///< of CallProgram
};

// executor.cpp
/// End of a run's code.
struct Ending {
  std::uint64_t blocks_executed = 0;
  std::optional<NcError> error;  ///< nothing when the program ended
};

/// Runs the main program of a channel to its end. If it fails, `channel.place()` is the block.
Ending execute_program(Channel& channel);

/// Runs the blocks from the instruction of a label to its LBL 0, for a cycle that needs a
/// subprogram. @errors those of the blocks; LBL 0 is missing.
NcResult<void> execute_label(Channel& channel, std::uint32_t label);

// exec_data.cpp
NcResult<Next> execute(Channel& channel, const klartext::ConditionalJump& jump);
NcResult<Next> execute(Channel& channel, const klartext::LabelCall& call, std::uint32_t counter);
NcResult<Next> execute(Channel& channel, const klartext::CallProgram& call);
NcResult<Next> execute(Channel& channel, const klartext::CallSelectedProgram& call);
NcResult<void> execute(Channel& channel, const klartext::SelectProgram& select);
/// Continues in a program. @errors it does not exist or has errors.
NcResult<Next> call_program(Channel& channel, const ControlPath& path);
NcResult<void> execute(Channel& channel, const klartext::Assignment& assignment);
NcResult<void> execute(Channel& channel, const klartext::SetUndefined& undefine);
NcResult<void> execute(Channel& channel, const klartext::CircleData& circle);
NcResult<void> execute(Channel& channel, const klartext::SystemWrite& write);
NcResult<void> execute(Channel& channel, const klartext::TableOpen& open);
NcResult<void> execute(Channel& channel, const klartext::TableWrite& write);
NcResult<void> execute(Channel& channel, const klartext::TableRead& read);
NcResult<void> execute(Channel& channel, const klartext::SelectTable& select);

NcResult<void> execute(Channel& channel, const klartext::ErrorStop& stop);
NcResult<void> execute(Channel& channel, const klartext::Print& print);
NcResult<void> execute(Channel& channel, const klartext::FormattedPrint& print);
NcResult<void> execute(Channel& channel, const klartext::ExternalFunction& function);
NcResult<void> execute(Channel& channel, const klartext::WaitFor& wait);
NcResult<void> execute(Channel& channel, const klartext::BlankForm& blank);

// exec_machine.cpp
NcResult<void> execute(Channel& channel, const klartext::ToolCall& call);
NcResult<void> execute(Channel& channel, const klartext::ToolDefinition& definition);
NcResult<Next> execute(Channel& channel, const klartext::Motion& motion);
NcResult<Next> execute(Channel& channel, const klartext::MFunctions& functions);
NcResult<Next> execute(Channel& channel, const klartext::Stop& stop);
NcResult<void> execute(Channel& channel, const klartext::Dwell& dwell);

/// M functions with effect at the start of the block: spindle and coolant on, TCPM.
NcResult<void> start_m_functions(Channel& channel, const std::vector<MCall>& calls);

/// M functions with effect at its end: spindle and coolant off, M140, stops, cycle call, end of the
/// program.
NcResult<Next> end_m_functions(Channel& channel, const MotionWords& words);

/// M140 MB, and MB of PLANE: away from the workpiece along the tool axis, in rapid traverse without
/// a feed.
NcResult<void> retract(Channel& channel, const MCall& call);

// exec_cycles.cpp
NcResult<Next> execute(Channel& channel, const klartext::Cycle& cycle, const BoundCycle& bound);
NcResult<Next> execute_parts(Channel& channel, std::uint32_t first, std::uint32_t last);
NcResult<Next> execute(Channel& channel, const klartext::CycleCall& call);
/// The cycle that M99, M89 and CYCL CALL run at the current position.
NcResult<Next> call_active_cycle(Channel& channel);

// patterns.cpp
NcResult<void> execute(Channel& channel, const klartext::PatternDefinition& pattern);

// exec_frames.cpp
NcResult<void> execute(Channel& channel, const klartext::Trans& trans);
NcResult<void> execute(Channel& channel, const klartext::Plane& plane);
NcResult<void> execute(Channel& channel, const klartext::FunctionTcpm& tcpm);

// frame_commands.cpp
using AxisCoordinates = std::array<std::optional<Coordinate>, machine::kAxes>;

/// Axes that are not named keep their shift.
NcResult<void> shift_datum(Channel& channel, const AxisCoordinates& axes);
/// A row of the datum table; blank cells keep their axis.
NcResult<void> shift_datum_to_row(Channel& channel, std::int64_t row);
NcResult<void> reset_datum_shift(Channel& channel);
/// Exactly the named axes are mirrored.
NcResult<void> mirror(Channel& channel, const std::array<bool, 3>& axes);
NcResult<void> rotate(Channel& channel, const Coordinate& angle);
/// @errors 1011 a factor that is not positive.
NcResult<void> scale(Channel& channel, const machine::Scaling& scaling);

/// Moves of PLANE that bring the rotary axes to a tilted plane.
struct PlaneMoves {
  klartext::PlanePositioning positioning = klartext::PlanePositioning::Stay;
  machine::Feed feed;
  bool turns_table = false;  ///< TABLE ROT: a free rotary axis turns; otherwise the coordinates
  std::optional<MCall> retraction{};  ///< MB: before the axes turn
  double distance = 0;  ///< DIST: from the tip along the tool to the point that keeps its place
  bool is_symmetric = false;  ///< SYM: the sign counts from the middle of the axis' range
  int sequence = 0;           ///< SEQ+ 1, SEQ- -1: the sign of the master axis; 0: the shortest way
};

/// Tilts the working plane by a rotation relative to the workpiece system and puts the rotary
/// positions that go with it into Q120 to Q122. The datum shift before it becomes the plane's
/// origin. @errors 1013 no rotary axes reach it.
NcResult<void> tilt(Channel& channel, const machine::Matrix3& rotation, const PlaneMoves& moves);
/// Moves all rotary axes to the position 0, by the word of PLANE.
NcResult<void> reset_tilt(Channel& channel, const PlaneMoves& moves);

// transformation_cycles.cpp
/// The axis words of a transformation with their values, in mm and degrees; other words are
/// ignored. Decision 3 applies: an undefined parameter is an error.
NcResult<AxisCoordinates> read_axis_words(Channel& channel, std::span<const Word> words);

/// X, Y and Z of a mirror. @errors for other axes.
NcResult<std::array<bool, 3>> mirrored_axes(std::span<const Word> words);

/// The cycles of CYCL DEF that are written in sub-lines and act when they are read: 7 datum shift,
/// 8 mirror, 9 dwell, 10 rotation, 11 scaling, 12 program call, 13 orientation, 19 working plane,
/// 26 scaling of each axis, 32 tolerance.
/// @param words of all sub-lines.
NcResult<void> execute_transformation(Channel& channel, int cycle, std::span<const Word> words);

}  // namespace fitgauge::interpreter

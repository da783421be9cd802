#pragma once

#include "nc/run/channel.hpp"

/// The parts of blocks as values of a run, and one function for each kind of block; a family is in
/// one exec_* file.
namespace fitgauge::interpreter {

// values.cpp
/// The values of the operands of a block, in the program that runs. Reading an undefined parameter
/// is an error that names it (decision 3); the executor adds the block.

NcResult<double> number(Channel& channel, const Expr& expr);
/// Returns a coordinate of a positioning block. An undefined parameter leaves its axis out
/// (decision 18).
NcResult<std::optional<double>> coordinate(Channel& channel, const Expr& expr);
/// A number that must be whole and between two bounds, both included. @errors 1011.
NcResult<int> whole_in(Channel& channel, const Expr& expr, int least, int most);
/// A whole number in the range of int. @errors 1011.
NcResult<int> whole(Channel& channel, const Expr& expr);

NcResult<std::string> text(Channel& channel, const Expr& expr);

/// A node of Equal, NotEqual, Greater, Less, IsDefined, IsUndefined.
NcResult<bool> condition(Channel& channel, NodeIndex index);

/// The numeric value of an inner node.
NcResult<double> evaluate(Channel& channel, NodeIndex index);

/// A number as TOCHAR writes it: with that many decimals, or without a number of them (-1) up to 6
/// without trailing zeros (decision 22).
std::string to_char(double value, int decimals);

/// The three letters of a month (1 to 12) as STR_MONTH of FN 16 prints them.
std::string_view month_name(int month);

// system_data.cpp
/// FN 18: SYSREAD. Always metric, in INCH programs too.
/// @errors an ID or NR this control does not have (decision 3), no such tool, preset or axis.
NcResult<double> read_system_data(Channel& channel, NodeIndex address);

/// FN 17: SYSWRITE of ID50 (tool table), ID500 (datum table) and ID503 (preset table).
NcResult<void> write_system_data(Channel& channel, NodeIndex address, double value);

enum class ToolWrite : std::uint8_t {
  Done,
  Unknown,    ///< no column has that number
  OutOfRange  ///< the column has whole numbers, and this is not one
};
/// Writes a column of tool.t by the NR of FN 17 and FN 18 ID50.
ToolWrite set_tool_value(machine::Tool& tool, std::int64_t nr, double value);

/// Notes a written L, R, DL or DR of a lathe tool, which counts its lengths by toolturn.trn.
NcResult<void> note_lathe_value(Channel& channel, const machine::Tool& tool, std::int64_t nr);

/// Returns whether a cell is Q108 to Q111, Q113 or Q114, to which the control gives a value. They
/// are undefined until a program reads them or calls a tool.
constexpr bool is_preassigned(std::uint32_t cell) {
  return cell >= kFirstQ + 108 && cell <= kFirstQ + 114 && cell != kFirstQ + 112;
}

/// Sets them to the values of the active tool, spindle and coolant, lengths in the unit of the
/// active program. Call it after a change of these.
void update_preassigned(Channel& channel);

/// Q120 to Q122: the rotary positions that PLANE or cycle 19 has computed, in degrees and input
/// coordinates, as `L A+Q120 C+Q122` needs them.
void set_plane_angles(Channel& channel, const machine::Vec3& rotary);

// motion_words.cpp, positioning.cpp
/// A number that may be relative to the end of the last block.
struct Coordinate {
  double value = 0;
  bool incremental = false;

  double after(double last) const { return incremental ? last + value : value; }
};

/// An M function with its words: `M140 MB50 F750`, `M128 F1000`.
struct MCall {
  int number = 0;
  std::optional<double> length{};        ///< MB, mm
  bool to_limit = false;                 ///< MB MAX
  std::optional<machine::Feed> feed{};   ///< of M140
  const ControlPath* program = nullptr;  ///< its replacement in the setup
};

/// The words of a positioning block as numbers, in mm, degrees and mm/min.
struct MotionWords {
  std::array<std::optional<Coordinate>, machine::kAxes> axes;
  std::optional<Coordinate> pr;
  std::optional<Coordinate> pa;
  std::optional<double> r;
  std::optional<double> len;
  std::optional<double> cca;
  std::optional<double> chamfer;
  std::optional<machine::Feed> feed;  ///< written in the block
  std::vector<MCall> m;

  bool names_axes() const;
  bool has_m(int number) const;
};

/// @errors an axis that the machine does not have, an unavailable M function; decision 18 applies
///   to coordinates, decision 3 to all others.
NcResult<MotionWords> read_words(Channel& channel, Slice<Word> words);

/// F, FMAX, FAUTO, FU or FZ as mm/min. @errors FT and FMAXT.
NcResult<machine::Feed> read_feed(Channel& channel, const Word& word);

/// The feed of a block: its word, which becomes modal unless it is FMAX, or the modal feed.
NcResult<machine::Feed> use_feed(Channel& channel, const std::optional<machine::Feed>& written);

/// Moves along one positioning block, or keeps what its next blocks decide.
NcResult<void> position(Channel& channel, const klartext::Motion& motion, const MotionWords& words);

/// @errors AxisMissing for U, V, W, which the simulated machine does not have.
NcResult<machine::Axis> machine_axis(Letter letter);

/// A length to a whole nanometre, as Q parameters get it (decision 21), without a negative zero.
inline double rounded_length(double mm) { return std::round(mm * 1e6) / 1e6 + 0.0; }

/// Returns the positions turned by whole turns into the ranges of the axes, each nearest to `from`.
std::optional<machine::Vec3> in_range(const machine::MachineState& state, machine::Vec3 rotary,
                                      const machine::Vec3& from);

/// Positions of the rotary axes that point the tool along `normal`, a unit vector fixed to the
/// table: in their ranges and the nearest to `from`, in machine coordinates.
std::optional<machine::Vec3> rotary_along(const machine::MachineState& state,
                                          const machine::Vec3& normal, const machine::Vec3& from);

/// TX TY TZ or NX NY NZ of an LN block, by their first letter. @errors it has no length.
NcResult<std::optional<machine::Vec3>> vector_of(Channel& channel, const klartext::Motion& motion,
                                                 Letter first);

/// Adds the positions of the rotary axes to a block that defines the tool's direction in the input
/// system: LN by its tool vector, else by its normal, any line by spatial angles. Of the positions
/// in the range of the axes the nearest is used.
/// @errors 1013 no position of the axes reaches it; a vector without length; the first block under
///   AXIS SPAT that turns the tool omits an angle.
NcResult<void> orient_tool(Channel& channel, const klartext::Motion& motion, MotionWords& words);

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
/// A row of the datum table; blank cells keep their axis.
NcResult<void> shift_datum_to_row(Channel& channel, std::int64_t row);
NcResult<void> reset_datum_shift(Channel& channel);

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

/// The cycles of CYCL DEF that are written in sub-lines and act when they are read: 7 datum shift,
/// 8 mirror, 9 dwell, 10 rotation, 11 scaling, 12 program call, 13 orientation, 19 working plane,
/// 26 scaling of each axis, 32 tolerance.
/// @param words of all sub-lines.
NcResult<void> execute_transformation(Channel& channel, int cycle, std::span<const Word> words);

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/run/call_stack.hpp"
#include "nc/run/contour.hpp"
#include "nc/run/formatted_printer.hpp"
#include "nc/run/interpreter.hpp"
#include "nc/run/machining.hpp"
#include "nc/run/motion_words.hpp"
#include "nc/run/table_access.hpp"

namespace fitgauge::interpreter {

/// Everything that one run owns: the parts of the control for its blocks. The executor moves it
/// from block to block; the exec_* files execute the blocks. Used by the thread of its run.
class Channel {
 public:
  Channel(std::shared_ptr<const LinkedProgram> main, const RunEnvironment& run_environment,
          const RunOptions& run_options, Allowance& allowance);

  // --- the program that runs
  const LinkedProgram& linked() const { return calls.program(); }
  const Program& program() const { return linked().program(); }
  Place place() const { return {&linked(), block}; }
  /// Returns the block (for FN 14, the jump to it if every block is traced), then the blocks that
  /// called it.
  std::vector<Place> chain() const;
  /// mm in one unit of a programmed length.
  double length_unit() const { return linked().is_inch() ? 25.4 : 1.0; }

  Machine& machine() const { return environment.machine; }
  const MachineState& state() const { return environment.machine.state(); }
  Timestamp now() const { return environment.clock.now(); }

  /// STOP, M0, M1: reported; the run continues, or ends by `on_stop`.
  NcResult<void> programmed_stop(std::string reason);
  NcResult<void> note(std::string text) { return log.note(std::move(text), place()); }
  template <class First, class... Rest>
  NcResult<void> note(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    return note(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

  /// A path as the program that runs names it.
  NcResult<ControlPath> resolve(std::string_view written) const;
  /// Returns the path of a file that the current program prints: in the folder of FN 16, if there
  /// is one and the name has none.
  NcResult<ControlPath> resolve_printed(std::string_view written) const;
  /// A program by its name in the current one; `.H` without an extension.
  NcResult<ControlPath> resolve_program(std::string_view written) const;
  /// The program, linked; each file is loaded once in a run.
  /// @errors it does not exist, it has errors, limit (memory).
  NcResult<std::shared_ptr<const LinkedProgram>> load_program(const ControlPath& path);

  const RunEnvironment& environment;
  const RunOptions& options;
  RunBudget budget;
  OutputBudget output;
  RunLog log;
  RunFiles files;
  QParameters parameters;
  CallStack calls;
  std::uint32_t block = 0;  ///< index of the running block
  /// The newest block and the block that ran before it, of any program, if every block is traced.
  Place entered;
  Place before;

  Contour contour;
  std::optional<SpatialAngles> spatial_angles;  ///< while A, B, C are angles of AXIS SPAT
  bool turns_along_vector = false;              ///< PATHCTRL VECTOR
  ActiveCycle active_cycle;
  /// Values of PREDEF, by the number of the Q parameter: mm, degrees, mm/min (GLOBAL DEF).
  std::map<int, double> predefined;
  FormattedPrinter printer;
  TableAccess tables;
  probing::CycleMemory cycle_memory;
  std::optional<machine::ContactPoint> last_touch;  ///< FN 18 ID 360
  std::optional<ControlPath> selected_program;      ///< SEL PGM
  int prepared_tool = 0;                            ///< TOOL DEF, until the next TOOL CALL
  bool stop_after_block = false;  ///< Q281 = 2 with on_stop=end: the run ends after this block

 private:
  std::map<std::string, std::shared_ptr<const LinkedProgram>> loaded_;  // by key
};

}  // namespace fitgauge::interpreter

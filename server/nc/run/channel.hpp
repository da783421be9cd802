#pragma once

#include "nc/run/contour.hpp"
#include "nc/run/interpreter.hpp"
#include "nc/run/machining.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter {

/// The cells of a program's code, and the strings. Q, QR and QS belong to the control and outlive
/// programs; QL, constants, counters and temporaries belong to the current program
/// (linked_program.hpp has the layout). An undefined parameter is a NaN; a defined one is finite.
/// Not thread-safe.
class QParameters {
 public:
  QParameters();

  double* cells() { return cells_.data(); }

  /// Returns the value; none if it is undefined. @pre not a QS
  std::optional<double> number(QRef parameter) const;
  /// @errors when the value is not finite.
  NcResult<void> set(QRef parameter, double value);
  /// @pre `value` is finite
  void set_q(std::uint16_t number, double value);

  /// Null when it is undefined.
  const std::string* string(std::uint16_t number) const;
  /// @errors when it has more than 255 characters.
  NcResult<void> set_string(std::uint16_t number, std::string value);

  void undefine(QRef parameter);
  bool is_defined(QRef parameter) const;

  /// State that a call of another program saves: the QL and the counters of repeats.
  std::vector<double> save_locals(const LinkedProgram& program) const;
  /// Switches to the cells of `program`: with saved locals, or fresh ones.
  void enter(const LinkedProgram& program, std::span<const double> saved = {});

  /// Everything defined: Q, QR, QS, then the QL of the program entered last.
  std::vector<ParameterValue> all() const;

 private:
  static constexpr std::size_t kLocals = parameter_count(QSpace::Ql);

  std::vector<double> cells_;
  std::vector<std::optional<std::string>> strings_;
};

/// The error of reading it: decision 3.
NcError undefined_error(QRef parameter);

/// The programs and subprograms that are being run, the main program first.
class CallStack {
 public:
  explicit CallStack(std::shared_ptr<const LinkedProgram> main) {
    programs_.push_back({std::move(main), {}, 0});
  }

  const LinkedProgram& program() const { return *programs_.back().program; }
  const LinkedProgram& main_program() const { return *programs_.front().program; }
  bool is_in_main() const { return programs_.size() == 1; }
  /// Returns the number of programs that call each other, with the main program.
  std::size_t depth() const { return programs_.size(); }
  /// The program that called this one, or null in the main program.
  const LinkedProgram* caller() const {
    return is_in_main() ? nullptr : programs_[programs_.size() - 2].program.get();
  }

  /// Returns the calling blocks of the present block, the innermost first.
  std::vector<Place> behind_calls() const;

  /// @errors 1025 too deep.
  NcResult<void> call_label(std::uint32_t return_to);
  /// The instruction to return to, or nothing outside of a subprogram.
  std::optional<std::uint32_t> return_from_label();

  /// The saved state of the caller.
  struct Caller {
    std::uint32_t return_to = 0;
    std::vector<double> locals;
  };
  /// @errors 1025 too deep.
  NcResult<void> call_program(std::shared_ptr<const LinkedProgram> program, Caller caller);
  /// @pre not in the main program
  Caller return_from_program();

 private:
  struct Activation {
    std::shared_ptr<const LinkedProgram> program;
    Caller caller;
    std::size_t first_label = 0;  ///< of the returns that belong to this program
  };

  static constexpr std::size_t kMostNested =
      19;  ///< of subprograms, and of programs: the control's (error 1025)

  std::vector<Activation> programs_;
  std::vector<std::uint32_t> label_returns_;
};

/// One run through a mask: its lines in the language of the control, and its settings for the file.
struct PrintedMask {
  std::vector<std::string> lines;
  bool close = false;
  bool append = false;
  bool truncate = false;
  std::optional<std::size_t> most_bytes;  ///< M_APPEND_MAX
};

/// The masks and files of FN 16: F-PRINT. Lines of one file are collected and written at M_CLOSE or
/// at the end of the run. Not thread-safe.
class FormattedPrinter {
 public:
  /// Both must outlive this object.
  FormattedPrinter(RunFiles& files, OutputBudget& budget) : files_(files), budget_(budget) {}

  /// A mask, as its file is now. @errors missing or malformed file.
  NcResult<std::shared_ptr<const klartext::MaskFile>> mask(const ControlPath& path);
  /// @errors limit.
  NcResult<void> print(const PrintedMask& printed, const ControlPath& path);
  /// Writes the collected lines. @errors limit.
  NcResult<void> close();

 private:
  struct Output {
    ControlPath path;
    std::string text;
    bool append = false;
    std::optional<std::size_t> most_bytes;
  };
  struct Known {
    std::string revision;
    std::shared_ptr<const klartext::MaskFile> mask;
  };

  NcResult<void> write(const Output& output);

  RunFiles& files_;
  OutputBudget& budget_;
  std::map<std::string, Output> outputs_;  // by key
  std::map<std::string, Known> masks_;     // by key
};

/// @errors those of its lines (an undefined parameter, a character code out of range), with their
/// place in the mask; limit.
NcResult<PrintedMask> run_mask(Channel& channel, const klartext::MaskFile& mask);

/// Tables of a run: the freely definable table that FN 26 has open (one at a time), and the datum
/// table. Each file is read once in a run. When the table is closed, the changes of FN 27 go to the
/// run's files. Not thread-safe.
class TableAccess {
 public:
  /// All must outlive this object.
  TableAccess(RunFiles& files, QParameters& parameters, Allowance& allowance)
      : files_(files), parameters_(parameters), allowance_(allowance) {}

  /// FN 26; closes the open table. @errors missing or malformed file, limit.
  NcResult<void> open(const ControlPath& path);
  /// FN 28. @param length_unit mm in one unit of the program's lengths. @errors no table open,
  /// missing row or column, empty or non-numeric cell.
  NcResult<void> read(QRef first, std::int64_t row, std::string_view columns,
                      double length_unit) const;
  /// FN 27. @errors as read.
  NcResult<void> write(QRef first, std::int64_t row, std::string_view columns, double length_unit);

  /// The name of the open table without its folder; empty: none is open.
  std::string_view open_name() const {
    return open_ ? open_->path.file_name() : std::string_view();
  }

  /// SEL TABLE. @errors as open.
  NcResult<void> select_datum_table(const ControlPath& path);
  bool has_datum_table() const { return datum_ != nullptr; }
  /// A cell of the datum table: mm or degrees; nothing if the axis has no column, or its cell
  /// is blank. @errors 1043, missing row, a cell that is no number.
  NcResult<std::optional<double>> datum(std::int64_t row, machine::Axis axis) const;
  /// @errors 1043, missing row or column.
  NcResult<void> write_datum(std::int64_t row, const machine::AxisWords& values);

  /// A number that FN 27 has written into tool.t: mm for lengths.
  struct ToolCell {
    int tool = 0;
    std::int64_t nr = 0;  ///< of the column, as FN 17 ID50 counts
    double value = 0;
  };
  /// Returns the numbers since the last call.
  std::vector<ToolCell> take_tool_cells() { return std::exchange(tool_cells_, {}); }

  /// Writes the changes. @errors limit.
  NcResult<void> close();
  const std::vector<OpenedTable>& opened() const { return opened_; }

 private:
  struct Table {
    ControlPath path;
    std::shared_ptr<const tabfile::TabTable> content;
    std::shared_ptr<tabfile::TabTable> changed = nullptr;  ///< the copy that is written to, if any
  };
  struct Known {
    std::string revision;
    std::shared_ptr<const tabfile::TabTable> content;
  };

  NcResult<Table> load(const ControlPath& path, std::string_view what);
  /// Loads a file as one of the two tables. They share their content if both are of this file.
  NcResult<void> load_as(std::shared_ptr<Table>& table, std::shared_ptr<Table>& other,
                         const ControlPath& path, std::string_view what);
  NcResult<void> save(const std::shared_ptr<Table>& table);
  /// The content to change: a copy of the file's.
  static tabfile::TabTable& editable(Table& table);

  RunFiles& files_;
  QParameters& parameters_;
  Allowance& allowance_;
  std::shared_ptr<Table> open_;
  std::shared_ptr<Table> datum_;
  std::map<std::string, Known> known_;  // by key
  std::vector<OpenedTable> opened_;
  std::vector<ToolCell> tool_cells_;
};

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
  /// While A, B and C are angles of FUNCTION TCPM AXIS SPAT: each as it was programmed last.
  std::optional<std::array<std::optional<double>, 3>> spatial_angles;
  bool turns_along_vector = false;  ///< PATHCTRL VECTOR
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

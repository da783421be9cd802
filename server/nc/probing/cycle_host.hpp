#pragma once

#include "base/clock.hpp"
#include "metrology/gauging/gauge.hpp"
#include "nc/machine/machine.hpp"
#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::probing {

using gauging::Limits;

/// The kind of a value, which decides the meaning of "out of tolerance".
enum class ValueRole : std::uint8_t {
  HoleSize,   ///< too small is rework, too large is reject
  ShaftSize,  ///< too large is rework, too small is reject
  Position,   ///< either side is reject (decision 1)
};

/// A measured value of a cycle with its texts for results, status, log and record. Lengths in whole
/// nanometres: the unit of comparisons with limits (decision 13) and of Q parameters (decision 21).
struct MeasuredValue {
  std::string_view characteristic{};  ///< "Diameter", as in the log: constant text
  ValueRole role = ValueRole::HoleSize;
  bool is_face = false;  ///< a position that is judged as a size, by the side of its material
  Length nominal{};
  Length measured{};
  std::optional<Limits> limits{};  ///< nothing when the block switches the check off
  std::uint16_t result_q = 0;      ///< receives the measured value; 0 is none
  std::uint16_t deviation_q = 0;   ///< receives the deviation; 0 is none
  int error_too_large = 1072;      ///< of Q309
  int error_too_small = 1072;
  std::optional<Length> uncertainty{};  ///< standard uncertainty, if it decides

  bool is_position() const { return is_face || role == ValueRole::Position; }
  /// Of a size or a face.
  iso286::Feature feature() const;
  Length deviation() const { return measured - nominal; }
  /// Its uncertainty makes a guard band.
  gauging::DecisionRule rule() const;
  /// Limits are inclusive (decision 1); nothing without limits.
  std::optional<gauging::Verdict> verdict() const;
  /// The error of Q309 when the value is out of tolerance, else 0.
  int error() const;
};

/// The judgement of form that the number of points of a circular feature allows.
struct Form {
  bool assessable = false;
  std::string reason{};                 ///< deviations that stay invisible
  std::optional<double> residual_mm{};  ///< largest distance of a point from the fitted circle
  double diameter_factor = 1;  ///< standard deviation of the diameter divided by that of one touch
  std::size_t points = 0;
  double start_angle_deg = 0;                    ///< of the first point, from the main axis
  std::optional<double> touch_uncertainty_um{};  ///< standard uncertainty, if the setup states it
  /// Range of the points' distances from the centre: a lower bound of the roundness. None for three
  /// points, which always are on a circle.
  std::optional<Length> deviation{};
};

/// The quantity that a cycle measures.
constexpr gauging::Quantity quantity_of(int cycle, bool is_position) {
  using gauging::Quantity;
  if (is_position || cycle == 427) return Quantity::Position;
  if (cycle == 444) return Quantity::Deviation;
  const bool is_width = (cycle >= 408 && cycle <= 411) || (cycle >= 423 && cycle <= 426) ||
                        cycle == 1404 || cycle == 1434;
  return is_width ? Quantity::Width : Quantity::Diameter;
}

/// The outcome of a measuring cycle, stored with the run.
struct MeasuringRecord {
  std::uint16_t cycle = 0;
  std::vector<MeasuredValue> sizes{};         ///< sizes, then positions; none for 0 and 1
  bool has_status = false;                    ///< its verdict is the run's until the next one
  std::optional<gauging::Verdict> verdict{};  ///< of the whole cycle; nothing without limits
  std::optional<Form> form{};                 ///< of circular features
};

/// Judges the diameter with its uncertainty, if the setup states the uncertainty of a touch. The
/// worst verdict becomes the verdict of the cycle. The control knows no uncertainty: its parameters
/// and its log do not change.
void judge_by_uncertainty(MeasuringRecord& record);

/// Cycle 441, modal until the program ends.
struct FastProbing {
  double positioning_feed = 0;  ///< Q396, mm/min; 0: FMAX of the probe
  bool machine_rapid = false;   ///< Q397: positions with the rapid of the machine
  bool interrupts = true;       ///< Q400: Q281 = 2 stops the program
};

/// Records of cycle 450, by name.
using KinematicsRecords = std::map<std::string, machine::Kinematics>;

/// Cycle 1493: repeats each touch of the next cycle, or of all cycles until the program ends.
struct Extrusion {
  machine::Vec3 step;     ///< from one touch to the next, in plane coordinates
  std::size_t count = 0;  ///< of repetitions
  bool is_modal = false;
};

/// State for later cycles of a run. The host owns it, gives the same one to every cycle
/// and calls `end_program` at END PGM, M2 and M30 of the main program.
struct CycleMemory {
  FastProbing fast_probing;
  std::optional<Extrusion> extrusion;
  /// The HTML logs that this run has begun, by file name and program: further sections join them.
  std::set<std::pair<std::string, std::string>> begun_logs;

  void end_program() {
    fast_probing = {};
    extrusion.reset();
    begun_logs.clear();
  }
};

/// The program around a cycle; the interpreter implements it. Lengths and feeds
/// are in mm and mm/min: the host converts for an INCH program, by the unit given.
class CycleHost {
 public:
  CycleHost& operator=(CycleHost&&) = delete;  // neither copied nor moved
  virtual ~CycleHost() = default;

  virtual void set_q(std::uint16_t number, double value, Unit unit) = 0;
  virtual CycleMemory& memory() = 0;

  /// The unit of a log: that of the main program.
  virtual bool log_is_inch() const = 0;
  /// The unit of the block of the cycle and its texts: that of the program that contains it.
  virtual bool block_is_inch() const = 0;
  /// The full path of the program that runs: `TNC:\nc_prog\8255\82551.h`.
  virtual std::string_view program_path() const = 0;
  virtual Timestamp now() const = 0;

  /// Appends a log to a file in the program's folder (or in the folder of FN 16), and creates the
  /// file if needed. @param name such as `TCHPR421.TXT`. @param text lines end with LF.
  /// @errors if the run's output budget is used up.
  virtual CycleResult<void> append_log(std::string_view name, std::string_view text) = 0;
  /// Writes a whole file there, new or replaced: `TCHPR444.html`.
  virtual CycleResult<void> write_log(std::string_view name, std::string_view text) = 0;
  /// Stops until NC Start. Returns at once; if a stop ends the run, it ends after the cycle.
  virtual void stop(std::string_view reason) = 0;
  /// Stops until NC Start confirms `reason`. @return false if a stop ends the run.
  virtual CycleResult<bool> confirm(std::string_view reason) = 0;
  /// Shows a message once in a run. @errors if the run's output budget is used up.
  virtual CycleResult<void> note(std::string_view text) = 0;
  /// Q281 = 2: shows the log on the screen and stops.
  virtual void show_and_stop(std::string_view text) = 0;

  virtual void record(const MeasuringRecord& record) = 0;
  /// The last touch, for FN 18 ID 360.
  virtual void touched(const machine::ContactPoint& contact) = 0;

  /// Writes the named axes (mm, degrees) of a row of the active datum table, relative to the
  /// preset.
  /// @errors 1043 no datum table is active.
  virtual CycleResult<void> write_datum(int row, const machine::AxisWords& values) = 0;

  /// The records of cycle 450 on the control's disk. @errors 1096 the file cannot be read.
  virtual CycleResult<KinematicsRecords> kinematics_records() = 0;
  /// Replaces them. @errors when the run's output budget is used up.
  virtual CycleResult<void> keep_kinematics(const KinematicsRecords& records) = 0;
};

/// A length in the nearest nanometre. @pre finite and within 1e12 mm.
Length to_length(double mm);

/// Results in mm, to the nanometre, in consecutive parameters.
void set_lengths(CycleHost& host, std::size_t first, std::initializer_list<double> mm);

constexpr Length magnitude(Length length) { return length < Length{} ? -length : length; }

/// An angle as Q parameters get it, to 1e-7 degrees (1 nm at 0.5 m), so that equal ones are equal.
double to_angle(double degrees);

/// The limits of a size from its two parameters; both 0 switch the check off.
/// @errors 1016 the maximum is less than the minimum.
CycleResult<std::optional<Limits>> size_limits(const Arguments& arguments, int max_q, int min_q);

/// Nominal position ± tolerance; a tolerance of 0 switches the check off (decision 21).
std::optional<Limits> position_limits(Length nominal, Length tolerance);

}  // namespace fitgauge::probing

#pragma once

#include "base/clock.hpp"
#include "nc/machine/machine.hpp"
#include "nc/probing/cycle_descriptor.hpp"
#include "nc/probing/cycle_fault.hpp"
#include "nc/probing/measuring_record.hpp"

namespace fitgauge::probing {

/// Cycle 441, modal until the program ends.
struct FastProbing {
  std::optional<double> positioning_feed;  ///< Q396, mm/min; nothing or 0: FMAX of the probe
  bool machine_rapid = false;              ///< Q397: positions with the rapid of the machine
  bool angle_tracking = true;              ///< Q399
  bool interrupts = true;                  ///< Q400: Q281 = 2 stops the program
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

  /// The unit of the main program, which a log uses too.
  virtual bool is_inch() const = 0;
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

}  // namespace fitgauge::probing

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/answers.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::virtual_control {

/// Starts a stored program on the control's machine, and waits until it is queued.
/// @errors as POST /v1/runs.
using StartProgram =
    std::function<Result<std::shared_ptr<app::ActiveRun>>(const interpreter::ControlPath&)>;

/// The machine as the DNC telegrams show it: that of the newest run, under way or over; before the
/// first one, at rest as its setup places it. For one thread.
class MachineView {
 public:
  MachineView(app::RunService& runs, machine::Setup setup, StartProgram start)
      : runs_(runs), setup_(std::move(setup)), start_(std::move(start)) {}

  control_link::Axes axes();
  control_link::Mode mode();
  control_link::ProgramState state();
  control_link::ProgramStack program();
  control_link::SpindleTool tool();
  std::vector<interpreter::RunMessage> errors();

  const machine::Setup& setup() const { return setup_; }

  void set_mode(control_link::Mode mode);
  /// @errors WrongMode while a program runs; NoFile; BadFormat: it has errors; InUse: too many
  /// wait.
  control_link::ControlResult<std::shared_ptr<app::ActiveRun>> start(
      const interpreter::ControlPath& program);
  /// Ends what runs, soon.
  void stop();

 private:
  std::shared_ptr<app::ActiveRun> newest();
  app::LiveState look();

  app::RunService& runs_;
  const machine::Setup setup_;
  const StartProgram start_;
  control_link::Mode mode_ = control_link::Mode::Manual;
  std::int64_t seen_run_ = 0;
  std::shared_ptr<app::ActiveRun> started_;  ///< the last one that a client has started
};

/// The PLC of a machine without one: every cell is 0 and every string empty.
control_link::Parameters control_parameters();

/// `count` bytes from `address`. @errors BadAddress.
control_link::ControlResult<control_link::Memory> read_memory(std::uint32_t address,
                                                              std::uint8_t count);

/// A value by its data path, `\PLC\memory\W\2`: the type that the path stands for, and 0.
/// @errors WrongParameter: a path of another tree.
control_link::ControlResult<control_link::DataValue> read_data_path(std::string_view path);

/// A bitmap (BMP) of 640 by 480: the simulation has no screen, so it is one colour, that of the
/// program's state: green runs, red failed, grey else.
std::string screen_dump(control_link::ProgramState state);

}  // namespace fitgauge::virtual_control

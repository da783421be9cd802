#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
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

}  // namespace fitgauge::virtual_control

#pragma once

#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/link_server.hpp"

namespace fitgauge::app {
class ActiveRun;
class FileService;
class RunService;
}  // namespace fitgauge::app

namespace fitgauge::virtual_control {

/// Differences between controls.
struct ControlModel {
  std::string_view name;  ///< as in `control-model` and R_VR
  std::string_view nc_software;
  bool is_itnc = false;
  bool asks_plc_password = true;  ///< of login FILEPLC
};

std::span<const ControlModel> control_models();

/// Starts a stored program on the control's machine, and waits until it is queued.
/// @errors as POST /v1/runs.
using StartProgram =
    std::function<Result<std::shared_ptr<app::ActiveRun>>(const interpreter::ControlPath&)>;

struct VirtualControlOptions {
  control_link::LinkServerOptions link;
  std::string model;         ///< a name of control_models()
  bool is_writable = false;  ///< false: files and the machine can only be read
  machine::Setup setup;      ///< of the machine it shows
  StartProgram start;
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// A file of clients/nc.
struct ExampleProgram {
  std::string_view path;  ///< `8255/8255.h`, below nc_prog
  std::string_view text;
};

std::span<const ExampleProgram> example_programs();

/// The simulated machine at an LSV-2 port.
using VirtualControl = control_link::LinkServer;

/// Adds the files of every control, an MDI program, a tool table and the example programs, unless
/// they are stored, and starts the machine. @param files, runs must outlive it.
/// @errors ListenFailed; ConfigInvalid: no such model; those of the storage.
Result<std::unique_ptr<VirtualControl>> start_virtual_control(VirtualControlOptions options,
                                                              app::FileService& files,
                                                              app::RunService& runs);

}  // namespace fitgauge::virtual_control

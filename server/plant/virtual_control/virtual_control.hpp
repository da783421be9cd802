#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plant/lsv2/link/link_server.hpp"
#include "plant/virtual_control/virtual_disk.hpp"

namespace fitgauge::virtual_control {

/// What differs from one control to the other.
struct ControlModel {
  std::string_view name;  ///< as `control-model` and R_VR say it
  std::string_view nc_software;
  bool is_itnc = false;
  bool asks_plc_password = true;  ///< of login FILEPLC

  /// The control's own files; the iTNC 530 has them in the root, in capitals.
  std::string_view mdi_program() const {
    return is_itnc ? "TNC:\\$MDI.H" : "TNC:\\nc_prog\\$mdi.h";
  }
  std::string_view tool_table() const { return is_itnc ? "TNC:\\TOOL.T" : "TNC:\\table\\tool.t"; }
  /// The machine parameter of the dialog language, and what it says.
  std::string_view language_parameter() const {
    return is_itnc ? "7230.0" : "CfgDisplayLanguage.ncLanguage";
  }
  std::string_view language() const { return is_itnc ? "0" : "ENGLISH"; }
};

std::span<const ControlModel> control_models();
/// Null where there is none of that name.
const ControlModel* find_model(std::string_view name);

}  // namespace fitgauge::virtual_control

namespace fitgauge::app {
class FileService;
}

namespace fitgauge::virtual_control {

struct VirtualControlOptions {
  control_link::LinkServerOptions link;
  std::string model;         ///< a name of control_models()
  bool is_writable = false;  ///< else files and the machine can only be read
  machine::Setup setup;      ///< of the machine it shows
  StartProgram start;
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// The simulated machine behind an LSV-2 port. It brings the files of every control: an MDI
/// program, a tool table and the example programs, each where none is stored.
class VirtualControl {
 public:
  /// @param files, runs outlive it.
  /// @errors ListenFailed; ConfigInvalid: no such model; those of the storage.
  static Result<std::unique_ptr<VirtualControl>> start(VirtualControlOptions options,
                                                       app::FileService& files,
                                                       app::RunService& runs);
  /// Closes every connection.
  ~VirtualControl();

  std::uint16_t port() const;

 private:
  struct Parts;
  explicit VirtualControl(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

/// A file of clients/nc.
struct ExampleProgram {
  std::string_view path;  ///< `8255/8255.h`, below nc_prog
  std::string_view text;
};

std::span<const ExampleProgram> example_programs();

}  // namespace fitgauge::virtual_control

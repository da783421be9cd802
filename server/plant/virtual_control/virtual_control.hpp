#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plant/lsv2/link/link_server.hpp"
#include "plant/virtual_control/machine_view.hpp"

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

}  // namespace fitgauge::virtual_control

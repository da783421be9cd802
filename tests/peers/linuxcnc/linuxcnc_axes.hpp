#pragma once

#include "nc/machine/axes.hpp"

namespace fitgauge::peers {

/// The axes of a running LinuxCNC, commanded through `bridge`, one line for each motion: G1 and
/// G38.2 with machine coordinates in mm. Not thread-safe.
class LinuxcncAxes final : public machine::Axes {
 public:
  /// Connects to the bridge's socket. Throws std::runtime_error when there is none.
  explicit LinuxcncAxes(const std::string& socket_path);
  ~LinuxcncAxes() override;

  machine::AxesCapabilities capabilities() const override { return {.curves = false}; }
  machine::Position nose() const override { return nose_; }
  machine::MachineResult<double> follow(const machine::Path& path,
                                        const machine::Motion& motion) override;
  machine::MachineResult<machine::Position> probe(const machine::Vec3& direction, double distance,
                                                  const machine::Motion& motion) override;
  machine::MachineResult<void> dwell(double seconds, Allowance& allowance) override;
  void stop(std::string_view reason) override;

 private:
  /// What the bridge says about a motion, and where the axes stand after it.
  struct Reply {
    std::string outcome;  ///< "done", "touched", "contact", "missed", "deflected", or a fault
    machine::Vec3 contact;
  };
  /// Sends a line and waits for its reply; a spent allowance aborts the motion.
  machine::MachineResult<Reply> ask(const std::string& line, Allowance& allowance);
  machine::MachineResult<std::string> read_line(Allowance& allowance);
  bool send_line(const std::string& line) const;

  int socket_;
  std::string unread_;
  machine::Position nose_;
};

}  // namespace fitgauge::peers

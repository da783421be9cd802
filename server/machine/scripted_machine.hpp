#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "machine/modelled_machine.hpp"

namespace fitgauge::machine {

/// What a probing move of a log found.
struct ScriptedContact {
  std::optional<Vec3> ball_centre;  ///< in mm; nothing: the move ended without contact
  CoordinateSystem system = CoordinateSystem::Input;
};

/// Replays the contacts of a real machine: every probing move takes the next one of a list. Nothing
/// stands on its table, so no other move meets anything. Not thread-safe.
class ScriptedMachine final : public ModelledMachine {
 public:
  /// A recorded contact may lie `tolerance` mm beside the probing line.
  /// @param allowance as of ModelledMachine
  /// @pre validate() accepts the setup that `setup` is part of.
  ScriptedMachine(const MachineSetup& setup, std::vector<ScriptedContact> contacts,
                  Allowance* allowance = nullptr, double tolerance = 0.05);

  std::size_t remaining() const { return contacts_.size() - next_; }

 private:
  void on_turn(const Vec3&) override {}
  double free_part(const Path&) override { return 1; }
  /// @faults ScriptExhausted; ScriptedDifferent when the recorded contact is not on this line.
  MachineResult<double> contact(const Vec3& direction, double distance) override;

  std::vector<ScriptedContact> contacts_;
  double tolerance_;
  std::size_t next_ = 0;
};

}  // namespace fitgauge::machine

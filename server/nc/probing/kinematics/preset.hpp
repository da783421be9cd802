#pragma once

#include "nc/probing/kinematics/probing.hpp"

namespace fitgauge::probing {

/// Q431: whether the active preset is set into the centre of the sphere before measuring, after it,
/// or both. Its zero then is the centre with all rotary axes at 0.
class PresetAtSphere {
 public:
  explicit PresetAtSphere(int q431)
      : sets_before_(q431 == 1 || q431 == 3), sets_after_(q431 >= 2) {}

  /// @errors 1085 the preset that is to be set is write-protected.
  CycleResult<void> check(const CycleContext& context) const;
  /// Finds the sphere below the probe and sets the preset, if that is asked for.
  CycleResult<void> before(const CycleContext& context, KinematicsProbing& probing) const;
  /// Turns all axes to 0, sets the preset if that is asked for, and retracts.
  CycleResult<void> after(const CycleContext& context, KinematicsProbing& probing) const;

 private:
  bool sets_before_;
  bool sets_after_;
};

}  // namespace fitgauge::probing

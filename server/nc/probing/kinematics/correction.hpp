#pragma once

#include "nc/probing/kinematics/fit.hpp"
#include "nc/probing/kinematics/probing.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// Corrections that the machine allows: with insignificant_corrections "note" all of them.
FitOptions fit_options(const CycleContext& context, bool directions);

/// Applies the corrected model to the machine, if there are corrections, and notes the omitted
/// ones. A correction beyond max_modification_mm waits for NC Start; if a stop ends the run nothing
/// is corrected.
/// @errors 1102 errors were found, and none of them is at least twice its uncertainty.
CycleResult<void> correct_kinematics(const CycleContext& context,
                                     std::span<const AxisErrors> errors, bool is_corrected,
                                     const machine::Kinematics& corrected);

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

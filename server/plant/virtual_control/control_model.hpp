#pragma once

#include <span>
#include <string_view>

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

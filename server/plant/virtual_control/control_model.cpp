#include "plant/virtual_control/control_model.hpp"

namespace fitgauge::virtual_control {
namespace {

constexpr ControlModel kModels[] = {
    {.name = "TNC640", .nc_software = "340595 08 SP1"},
    {.name = "TNC7", .nc_software = "817625 17 SP1"},
    {.name = "TNC320", .nc_software = "771855 05 SP1"},
    {.name = "iTNC530", .nc_software = "340494 08 SP1", .is_itnc = true},
    {.name = "iTNC530 Programming station",
     .nc_software = "340494 08 SP1",
     .is_itnc = true,
     .asks_plc_password = false},
};

}  // namespace

std::span<const ControlModel> control_models() { return kModels; }

const ControlModel* find_model(std::string_view name) {
  for (const ControlModel& model : kModels) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

}  // namespace fitgauge::virtual_control

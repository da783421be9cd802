#pragma once

#include <memory>

#include "api/services.hpp"
#include "daemon/config.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"
#include "plant/virtual_control/virtual_control.hpp"

namespace fitgauge::daemon {

/// Opens the LSV-2 port of the configuration; null where it names none. The control goes before
/// `services`. @errors as VirtualControl::start.
Result<std::unique_ptr<virtual_control::VirtualControl>> start_control(
    const Config& config, const api::Services& services);

/// Opens the SHDR port of the configuration; null where it names none. The adapter goes before
/// `services`. @errors as ShdrAdapter::start.
Result<std::unique_ptr<mtconnect::ShdrAdapter>> start_shdr(const Config& config,
                                                           const api::Services& services);

}  // namespace fitgauge::daemon

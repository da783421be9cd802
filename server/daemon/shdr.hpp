#pragma once

#include <memory>

#include "api/services.hpp"
#include "daemon/config.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"

namespace fitgauge::daemon {

/// Opens the SHDR port of the configuration; null where it names none. The adapter goes before
/// `services`. @errors as ShdrAdapter::start.
Result<std::unique_ptr<shdr::ShdrAdapter>> start_shdr(const Config& config,
                                                      const api::Services& services);

}  // namespace fitgauge::daemon

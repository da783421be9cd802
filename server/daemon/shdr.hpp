#pragma once

#include <memory>

#include "base/clock.hpp"
#include "daemon/config.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// Opens the SHDR port of the configuration; null where it names none. The adapter goes before
/// `app`. @errors as ShdrAdapter::start.
Result<std::unique_ptr<shdr::ShdrAdapter>> start_shdr(const Config& config, app::Application& app,
                                                      const Clock& clock);

}  // namespace fitgauge::daemon

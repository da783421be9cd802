#pragma once

#include <memory>
#include <stop_token>

#include "plant/lsv2/collector_options.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {

/// Reads measuring logs from a control over LSV-2. It logs in as INSPECT and FILE, and only lists
/// and reads. A machine that is away is asked again after twice the time, up to ten minutes.
/// @param plant outlives it.
std::unique_ptr<Worker> make(const MachineOptions& machine, const Plant& plant);

/// Logs in and lists the watched folders once. Waits.
ConnectionTest test_of(const MachineOptions& machine, const Plant&, const std::stop_token& stop);

}  // namespace fitgauge::connections

#pragma once

#include <memory>
#include <stop_token>

#include "plant/definition.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {

/// Of an outgoing connection; else null.
const FollowerOptions* follower_options(const Definition& definition);

/// Starts what a definition says. @param plant outlives it.
std::unique_ptr<Worker> make_worker(const Definition& definition, const Plant& plant);

/// Tries the other side once, beside the worker. Waits up to half a minute.
ConnectionTest test_connection(const Definition& definition, const Plant& plant,
                               const std::stop_token& stop);

}  // namespace fitgauge::connections

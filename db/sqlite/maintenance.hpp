#pragma once

#include "base/clock.hpp"
#include "sqlite/session.hpp"
#include "store/open_options.hpp"

namespace fitgauge::store {

/// One small step of what can wait until nothing else is to be written, in a transaction of its
/// own: expired answers, old runs and old events are deleted. @returns whether there is more to do.
bool tidy(Session& session, const OpenOptions& options, Timestamp now);

}  // namespace fitgauge::store

#pragma once

#include <memory>

#include "base/clock.hpp"
#include "base/result.hpp"
#include "store/database.hpp"
#include "store/open_options.hpp"

namespace fitgauge::store::postgres {

/// Opens the schema `fitgauge` of the database at OpenOptions::address, which several daemons
/// share, and makes it where there is none. `clock` outlives the database.
/// @errors StorageUnavailable while the server cannot be reached, or has no such schema and access
///   is Attach; DatabaseForeign, DatabaseNewer.
Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

}  // namespace fitgauge::store::postgres

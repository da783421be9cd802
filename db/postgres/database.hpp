#pragma once

#include <memory>
#include <string>

#include "base/clock.hpp"
#include "base/result.hpp"
#include "db/store/database.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store::postgres {

/// Opens the schema `fitgauge` of the database at OpenOptions::address, which several daemons
/// share, and makes it where there is none. `clock` outlives the database.
/// @errors StorageUnavailable while the server cannot be reached, or has no such schema and access
///   is Attach; DatabaseForeign, DatabaseNewer.
Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

/// Whether a daemon could start on it: it takes connections and writes, and has this build's schema
/// or none yet. Changes nothing. @errors StorageUnavailable, DatabaseNewer, DatabaseForeign.
Result<void> check_server(const std::string& address);

}  // namespace fitgauge::store::postgres

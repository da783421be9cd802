#pragma once

#include <string>

#include "base/result.hpp"

namespace fitgauge::app {

/// Whether a daemon could start on the database at `address` (`postgresql://…`); changes nothing.
/// @errors StorageUnavailable, DatabaseNewer, DatabaseForeign, each naming the server's reason.
Result<void> check_database(const std::string& address);

}  // namespace fitgauge::app

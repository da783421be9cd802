#pragma once

#include <cstdint>
#include <string_view>

#include "base/result.hpp"
#include "postgres/connection.hpp"

namespace fitgauge::store::postgres {

/// The schema this build knows, from db/migrations/postgres.
std::string_view schema();

/// Makes the schema where there is none, and checks it against this build's where there is. Of
/// several daemons that start at once one makes it.
/// @param may_create else it must be there. @pre the connection is new.
/// @errors DatabaseNewer, DatabaseForeign; StorageUnavailable when it may not be made.
Result<void> prepare_schema(const std::string& address, bool may_create, std::int64_t now_ns);

}  // namespace fitgauge::store::postgres

#pragma once

#include <cstdint>
#include <span>

#include "base/result.hpp"
#include "db/postgres/connection.hpp"
#include "db/sql/migration.hpp"

namespace fitgauge::store::postgres {

/// The steps this build knows, from db/migrations/postgres.
std::span<const sql::Migration> migrations();

/// Makes the schema where there is none, takes the steps that one of an older version lacks, and
/// checks those it has against this build's. Of several daemons that start at once one does it;
/// those of the older version that are still running go on.
/// @param may_change else it must be there and complete. @pre the connection is new.
/// @errors DatabaseNewer, DatabaseForeign; StorageUnavailable when it may not be made.
Result<void> prepare_schema(const std::string& address, bool may_change, std::int64_t now_ns);

}  // namespace fitgauge::store::postgres

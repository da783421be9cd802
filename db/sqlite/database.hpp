#pragma once

#include <memory>

#include "base/clock.hpp"
#include "base/result.hpp"
#include "db/store/database.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store::sqlite {

/// Opens `fitgauge.db` of a data directory, creating it where the directory has none, with a thread
/// that checks it. The file is created aside and renamed, and an upgrade is one transaction after a
/// backup, so that a kill leaves the old state or the new one. `clock` outlives the database, whose
/// end checkpoints.
/// @errors DatabaseInUse when another instance serves the directory; DatabaseForeign when the file
///   is empty, not SQLite's, or not fitgauge's; DatabaseNewer; StorageCorrupt when the check fails
///   (the file is left untouched in all these); StorageUnavailable when the directory cannot be
///   written, or holds no database and access is Attach.
Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

}  // namespace fitgauge::store::sqlite

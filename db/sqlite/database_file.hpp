#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/result.hpp"
#include "db/sqlite/migrator.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Makes `fitgauge.db` of the options' directory ready for use with the schema `known`: creates it
/// or checks it, and upgrades it after a backup (`fitgauge.db.schema-N.backup`).
/// With Access::Attach it must be there and have just this schema.
/// @errors as open_database(), except DatabaseInUse.
Result<void> prepare_file(const OpenOptions& options, std::span<const sqlite::Migration> known,
                          std::int64_t now_ns);

/// Copies the live database into a new file, durable when it returns.
/// @errors StorageUnavailable, also when `target` exists.
Result<void> copy_database(const std::filesystem::path& source,
                           const std::filesystem::path& target);

}  // namespace fitgauge::store

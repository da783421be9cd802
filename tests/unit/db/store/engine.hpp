#pragma once

#include "base/clock.hpp"
#include "db/store/database.hpp"

namespace fitgauge::store::test {

/// A database of its own in a server that lives as long as the tests; fails the test where there is
/// no PostgreSQL.
void prepare_engine(OpenOptions& options);

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

/// Past the stores.
void execute(const OpenOptions& options, const std::string& sql);
std::int64_t query_integer(const OpenOptions& options, const std::string& sql);
std::string migration(std::size_t number);

}  // namespace fitgauge::store::test

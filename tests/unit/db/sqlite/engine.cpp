#include "engine.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/database.hpp"

namespace fitgauge::store::test {

void prepare_engine(OpenOptions& /*options*/) {}

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock) {
  return sqlite::open_database(options, clock);
}

void execute(const OpenOptions& options, const std::string& sql) {
  sqlite::Connection(options.directory / "fitgauge.db", sqlite::Mode::Write).execute(sql);
}

std::int64_t query_integer(const OpenOptions& options, const std::string& sql) {
  return sqlite::Connection(options.directory / "fitgauge.db", sqlite::Mode::Read)
      .query_integer(sql);
}

std::string migration(std::size_t number) {
  return std::string(sqlite::migrations()[number - 1].sql);
}

}  // namespace fitgauge::store::test

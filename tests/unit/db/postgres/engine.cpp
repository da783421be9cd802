#include "engine.hpp"

#include <doctest/doctest.h>

#include "db/postgres/connection.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/database.hpp"
#include "support/files.hpp"

namespace fitgauge::store::test {
namespace {

constexpr const char* kCluster = "tests/support/postgres_cluster";

/// Lives until the process ends. Its files are of a test: nothing waits for a disk, and nothing is
/// written out because time has passed.
class Cluster {
 public:
  Cluster() {
    const std::string start =
        fmt::format("{} start {} fsync=off full_page_writes=off wal_writer_delay=10s", kCluster,
                    folder_.path().string());
    REQUIRE_MESSAGE(std::system(start.c_str()) == 0,
                    "PostgreSQL does not start: scripts/install test");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  ~Cluster() {
    const std::string stop = fmt::format("{} stop {} immediate", kCluster, folder_.path().string());
    [[maybe_unused]] const int code = std::system(stop.c_str());
  }

  std::string address(const std::string& database) const {
    return fmt::format("postgresql:///{}?host={}&user=postgres", database, folder_.path().string());
  }

 private:
  TemporaryFolder folder_;
};

const Cluster& cluster() {
  static const Cluster made;
  return made;
}

}  // namespace

void prepare_engine(OpenOptions& options) {
  static int made = 0;
  const std::string name = fmt::format("test_{}", ++made);
  postgres::Connection connection(cluster().address("postgres"));
  connection.send("CREATE DATABASE " + name);
  connection.wait();
  options.address = cluster().address(name);
}

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock) {
  return postgres::open_database(options, clock);
}

void execute(const OpenOptions& options, const std::string& sql) {
  postgres::Connection connection(options.address);
  connection.send(sql);
  connection.wait();
}

std::int64_t query_integer(const OpenOptions& options, const std::string& sql) {
  postgres::Connection connection(options.address);
  sql::Statement statement(connection, sql);
  return statement.returning<std::int64_t>();
}

std::string migration(std::size_t number) {
  return std::string(postgres::migrations()[number - 1].sql);
}

}  // namespace fitgauge::store::test

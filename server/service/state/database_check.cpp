#include "service/state/database_check.hpp"

#include "db/postgres/database.hpp"

namespace fitgauge::app {

Result<void> check_database(const std::string& address) {
  return store::postgres::check_server(address);
}

}  // namespace fitgauge::app

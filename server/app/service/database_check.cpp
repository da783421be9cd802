#include "app/service/database_check.hpp"

#include "postgres/database.hpp"

namespace fitgauge::app {

Result<void> check_database(const std::string& address) {
  return store::postgres::check_server(address);
}

}  // namespace fitgauge::app

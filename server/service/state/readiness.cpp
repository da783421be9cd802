#include "service/state/readiness.hpp"

#include "db/store/database.hpp"
#include "service/log/log_service.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {

Readiness readiness(const Database& database, const TableCatalog& tables, const LogService& log) {
  Readiness readiness{.findings = tables.state()->findings, .database = "ok"};
  const store::Health health = database.health();
  switch (health.state) {
    case store::HealthState::Ok: break;
    case store::HealthState::Checking: readiness.database = "checking"; break;
    case store::HealthState::WritesFailing:
      readiness.findings.push_back({ErrorCode::StorageUnavailable, health.reason, "database"});
      break;
    case store::HealthState::Damaged:
      readiness.findings.push_back({ErrorCode::StorageCorrupt, health.reason, "database"});
      break;
  }
  if (auto forked = log.forked()) readiness.findings.push_back(*std::move(forked));
  return readiness;
}

Result<void> check_database(const std::string& address) {
  return store::postgres::check_server(address);
}

}  // namespace fitgauge::app

#include "db/store/stores.hpp"

namespace fitgauge::store {

Stores::Stores(sql::Connection& connection, const Clock& clock,
               std::chrono::hours idempotency_retention)
    : tables(connection),
      measurements(connection),
      notes(connection),
      idempotency(connection, clock, idempotency_retention),
      keys(connection),
      files(connection),
      documents(connection),
      changes(connection),
      runs(connection),
      events(connection),
      log(connection),
      origins(connection),
      revisions(connection) {}

}  // namespace fitgauge::store

#pragma once

#include "base/clock.hpp"
#include "db/store/documents_store.hpp"
#include "db/store/keys_store.hpp"
#include "db/store/log_store.hpp"
#include "db/store/measurements_store.hpp"
#include "db/store/runs_store.hpp"
#include "db/store/tables_store.hpp"

namespace fitgauge::store {

/// Broken storage: a full or failing disk, a damaged page. Caught at the border of the writer and
/// of the read pool, where it becomes its Error.
class StorageFailure : public std::runtime_error {
 public:
  explicit StorageFailure(Error error)
      : std::runtime_error(error.message), error_(std::move(error)) {}

  const Error& error() const { return error_; }

 private:
  Error error_;
};

/// The stores of one connection. Const is reading: a read job sees `const Stores&`, a write job
/// `Stores&`. Used by the connection's thread alone. Every function throws StorageFailure when the
/// storage fails; the writer and the read pool turn that into an Error.
struct Stores {
  Stores(sql::Connection& of, const Clock& clock, std::chrono::hours idempotency_retention)
      : connection(of), idempotency(of, clock, idempotency_retention) {}

  sql::Connection& connection;
  IdempotencyStore idempotency;
  TablesStore tables{connection};
  MeasurementsStore measurements{connection};
  NotesStore notes{connection};
  KeysStore keys{connection};
  FilesStore files{connection};
  DocumentsStore documents{connection};
  ChangesStore changes{connection};
  RunsStore runs{connection};
  EventsStore events{connection};
  LogStore log{connection};
  OriginsStore origins{connection};
  RevisionsStore revisions{connection};
};

}  // namespace fitgauge::store

#pragma once

#include "base/clock.hpp"
#include "base/result.hpp"
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

namespace sql {
class Connection;
}

/// The stores of one connection. Const is reading: a read job sees `const Stores&`, a write job
/// `Stores&`. Used by the connection's thread alone. Every function throws StorageFailure when the
/// storage fails; the writer and the read pool turn that into an Error.
struct Stores {
  Stores(sql::Connection& connection, const Clock& clock, std::chrono::hours idempotency_retention)
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

  TablesStore tables;
  MeasurementsStore measurements;
  NotesStore notes;
  IdempotencyStore idempotency;
  KeysStore keys;
  FilesStore files;
  DocumentsStore documents;
  ChangesStore changes;
  RunsStore runs;
  EventsStore events;
  LogStore log;
  OriginsStore origins;
  RevisionsStore revisions;
};

}  // namespace fitgauge::store
